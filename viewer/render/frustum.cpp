#include "viewer/render/frustum.h"

namespace fluxwalk::render {

// Gribb and Hartmann 2001: -w <= x, y, z <= w, each written in world space, is a sum of rows of the matrix.
Frustum::Frustum(const glm::mat4& clipFromWorld) {
    const glm::dmat4 rows = glm::transpose(glm::dmat4(clipFromWorld));
    for (int axis = 0; axis < 3; ++axis) {
        planes_[static_cast<std::size_t>(2 * axis)] = rows[3] + rows[axis];
        planes_[static_cast<std::size_t>(2 * axis + 1)] = rows[3] - rows[axis];
    }
}

bool Frustum::isOutside(const base::Box& box) const {
    for (const glm::dvec4& plane : planes_) {
        const base::Vec3d farthest(plane.x > 0.0 ? box.upper.x : box.lower.x,
                                   plane.y > 0.0 ? box.upper.y : box.lower.y,
                                   plane.z > 0.0 ? box.upper.z : box.lower.z);
        if (glm::dot(base::Vec3d(plane), farthest) + plane.w < 0.0) {
            return true;
        }
    }
    return false;
}

double distanceTo(const base::Box& box, const base::Vec3d& point) {
    return glm::length(glm::max(glm::max(box.lower - point, point - box.upper), base::Vec3d(0.0)));
}

}  // namespace fluxwalk::render
