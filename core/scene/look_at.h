#pragma once

#include "core/scene/scene.h"

namespace fluxwalk::scene {

/// Camera at `eye` that looks at `target`, upright. Throws base::UsageError where they coincide or the angle
/// is not in (0, 180) degrees.
Camera lookAt(const Vec3d& eye, const Vec3d& target, double verticalFovDegrees);

}  // namespace fluxwalk::scene
