#include "viewer/render/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/base/photometry.h"

namespace fluxwalk::render {

using base::Vec3d;

ClipRange clipRangeFor(const scene::Camera& camera, const base::Box& bounds) {
    if (bounds.isEmpty()) {
        return {0.01, 100.0};
    }
    const Vec3d farthestCorner =
        glm::max(glm::abs(bounds.lower - camera.position), glm::abs(bounds.upper - camera.position));
    // 24 bits of depth resolve z^2 / (nearest * 2^24): 1 mm at 18 m for 2 cm.
    const double nearest = std::clamp(2e-3 * bounds.diagonal(), 1e-3, 0.02);
    return {nearest, std::max(2.0 * nearest, 1.01 * glm::length(farthestCorner) + nearest)};
}

Vec3d directionAt(const scene::Camera& camera, double aspect, const base::Vec2d& place) {
    const Vec3d right = glm::normalize(glm::cross(camera.forward, camera.up));
    const Vec3d up = glm::cross(right, camera.forward);
    const double height = std::tan(0.5 * camera.verticalFov);
    return glm::normalize(camera.forward + height * (aspect * place.x * right + place.y * up));
}

glm::mat4 clipFromWorld(const scene::Camera& camera, double aspect, const ClipRange& range) {
    const glm::dmat4 view = glm::lookAt(camera.position, camera.position + camera.forward, camera.up);
    return glm::mat4(glm::perspective(camera.verticalFov, aspect, range.nearest, range.farthest) * view);
}

}  // namespace fluxwalk::render
