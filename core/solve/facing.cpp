#include "core/solve/facing.h"

#include <algorithm>
#include <cmath>

#include "core/base/normal_cone.h"

namespace fluxwalk::solve {

using base::Vec3d;
using hierarchy::Shape;

bool isBehind(const Shape& plane, const Shape& other, float tolerance) {
    if (!plane.isPlanar || plane.cornerCount == 0) {
        return false;
    }
    const base::Vec3& n = plane.axis;
    const float offset = glm::dot(n, plane.corners[0]);
    if (!other.isPlanar || other.cornerCount == 0) {
        return glm::dot(n, other.center) + other.radius <= offset + tolerance;
    }
    for (std::uint32_t i = 0; i < other.cornerCount; ++i) {
        if (glm::dot(n, other.corners[i]) > offset + tolerance) {
            return false;
        }
    }
    return true;
}

bool facesAway(const Shape& from, const Shape& to) {
    const base::Vec3 d = to.center - from.center;
    const float distance = glm::length(d);
    const float reach = from.radius + to.radius;
    if (distance <= reach) {
        return false;
    }
    const double between = base::NormalCone::angleBetween(Vec3d(from.axis), glm::normalize(Vec3d(d)));
    const double delta = std::asin(std::min(1.0, static_cast<double>(reach / distance)));
    return between - static_cast<double>(from.halfAngle) - delta >= 0.5 * base::kPi;
}

}  // namespace fluxwalk::solve
