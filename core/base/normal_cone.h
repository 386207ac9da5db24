#pragma once

#include <cmath>

#include "core/base/photometry.h"
#include "core/base/vec.h"

namespace fluxwalk::base {

/// Set of unit normals within `halfAngle` (radians) of `axis`. halfAngle >= pi holds every direction.
struct NormalCone {
    Vec3d axis{0.0, 0.0, 1.0};
    double halfAngle = 0.0;

    /// Angle between two unit vectors, accurate near 0 and pi.
    static double angleBetween(const Vec3d& a, const Vec3d& b) {
        return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
    }

    /// Smallest cone about the mean of the two axes that holds both cones.
    static NormalCone merge(const NormalCone& a, const NormalCone& b) {
        const double between = angleBetween(a.axis, b.axis);
        if (between + b.halfAngle <= a.halfAngle) {
            return a;
        }
        if (between + a.halfAngle <= b.halfAngle) {
            return b;
        }
        const double half = 0.5 * (between + a.halfAngle + b.halfAngle);
        if (half >= kPi) {
            return {a.axis, kPi};
        }
        // Turn a's axis towards b's by (half - a.halfAngle). Axes that were stored as float have unit length
        // to 1e-7 only: then what is left of nearly opposite ones would not be perpendicular.
        const Vec3d from = glm::normalize(a.axis);
        const Vec3d to = glm::normalize(b.axis);
        const Vec3d side = to - glm::dot(from, to) * from;
        const double sideLength = glm::length(side);
        if (sideLength < 1e-6) {
            return {a.axis, kPi};
        }
        const double turn = half - a.halfAngle;
        return {glm::normalize(std::cos(turn) * from + std::sin(turn) / sideLength * side), half};
    }
};

}  // namespace fluxwalk::base
