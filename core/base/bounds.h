#pragma once

#include <algorithm>
#include <limits>

#include "core/base/vec.h"

namespace fluxwalk::base {

/// Axis-aligned box in metres; empty by default.
struct Box {
    Vec3d lower{std::numeric_limits<double>::infinity()};
    Vec3d upper{-std::numeric_limits<double>::infinity()};

    bool isEmpty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    void extend(const Vec3d& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const Box& b) {
        lower = glm::min(lower, b.lower);
        upper = glm::max(upper, b.upper);
    }
    Vec3d center() const { return 0.5 * (lower + upper); }
    Vec3d size() const { return isEmpty() ? Vec3d(0.0) : upper - lower; }
    double diagonal() const { return glm::length(size()); }
};

}  // namespace fluxwalk::base
