#include "core/scene/look_at.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/photometry.h"

namespace fluxwalk::scene {

Camera lookAt(const Vec3d& eye, const Vec3d& target, double verticalFovDegrees) {
    const Vec3d toTarget = target - eye;
    const double distance = glm::length(toTarget);
    if (!(distance > 0.0) || !std::isfinite(distance)) {
        throw base::UsageError("the camera's eye and target must be two different points");
    }
    if (!(verticalFovDegrees > 0.0 && verticalFovDegrees < 180.0)) {
        throw base::UsageError("the camera's field of view must lie between 0 and 180 degrees");
    }
    Camera camera;
    camera.position = eye;
    camera.forward = toTarget / distance;
    // Looking straight up or down, north (-z) is up in the picture.
    const bool isVertical = std::abs(camera.forward.y) > 1.0 - 1e-9;
    camera.up = isVertical ? Vec3d(0.0, 0.0, -1.0) : Vec3d(0.0, 1.0, 0.0);
    camera.verticalFov = verticalFovDegrees * base::kPi / 180.0;
    return camera;
}

}  // namespace fluxwalk::scene
