#pragma once

#include <functional>

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// For a quad of these lengths (any unit) along u and v: strips while they are nearer to squares than
/// quarters.
Strips chooseStrips(double alongU, double alongV);

/// The same for a curved quad: its lengths are those of lines of chords through `at(uv)` along both sides and
/// the middle.
Strips measureStrips(const std::function<Vec3d(const Vec2d& uv)>& at);

}  // namespace fluxwalk::surface
