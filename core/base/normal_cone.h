#pragma once

#include <algorithm>
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

/// Tells which unit vectors are no further apart than an angle (radians), as NormalCone::angleBetween does,
/// but by their distance where that is clear.
class AngleLimit {
  public:
    explicit AngleLimit(double angle) : angle_(angle) {
        const double chord = 2.0 * std::sin(0.5 * std::min(angle, kPi));
        constexpr double kClear = 1e-9;
        // Near pi distances hardly differ.
        if (angle < 3.0) {
            surelyWithin_ = (1.0 - kClear) * chord * chord;
            surelyBeyond_ = (1.0 + kClear) * chord * chord;
        }
    }

    bool holds(const Vec3d& a, const Vec3d& b) const {
        const Vec3d between = a - b;
        const double squared = glm::dot(between, between);
        if (squared < surelyWithin_) {
            return true;
        }
        return squared <= surelyBeyond_ && NormalCone::angleBetween(a, b) <= angle_;
    }

  private:
    double angle_;
    double surelyWithin_ = 0.0;
    double surelyBeyond_ = 8.0;  ///< above the square of any distance
};

}  // namespace fluxwalk::base
