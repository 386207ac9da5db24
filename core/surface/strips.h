#pragma once

#include <functional>

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// For a quad of these lengths (any unit) along u and v: strips while they are nearer to squares than
/// quarters.
Strips chooseStrips(double alongU, double alongV);

/// The same for a curved quad: its lengths are those of lines of chords through `at(uv)` along both sides and
/// the middle. It is quartered once before, since light changes with the way a surface turns: of a quarter
/// turn, 45 degrees are left.
Strips measureStrips(const std::function<Vec3d(const Vec2d& uv)>& at);

}  // namespace fluxwalk::surface
