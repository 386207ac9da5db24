#include "core/surface/turns.h"

#include <cmath>

#include "core/base/check.h"

namespace fluxwalk::surface {

namespace {

using base::kPi;

constexpr double kQuarter = 0.5 * kPi;

double cross(const Vec2d& a, const Vec2d& b) {
    return a.x * b.y - a.y * b.x;
}

// `at` turned by `quarter` quarter turns. 0 - x instead of -x: no minus zero comes out.
Vec2d turned(unsigned quarter, const Vec2d& at) {
    switch (quarter & 3u) {
        case 0:
            return at;
        case 1:
            return {0.0 - at.y, at.x};
        case 2:
            return {0.0 - at.x, 0.0 - at.y};
        default:
            return {at.y, 0.0 - at.x};
    }
}

}  // namespace

Vec2d turnAt(unsigned quarter, double part) {
    // From the nearer end, so that both ends are exact.
    if (part <= 0.5) {
        const double angle = kQuarter * part;
        return turned(quarter, {std::cos(angle), std::sin(angle)});
    }
    const double angle = kQuarter * (1.0 - part);
    return turned(quarter, {std::sin(angle), std::cos(angle)});
}

unsigned quarterOf(const Vec2d& at) {
    if (at.x >= 0.0) {
        return at.y >= 0.0 ? 0u : 3u;
    }
    return at.y >= 0.0 ? 1u : 2u;
}

double partOfQuarter(unsigned quarter, const Vec2d& at) {
    const Vec2d first = turned(4u - (quarter & 3u), at);
    // Measured from the quarter's middle: what lies behind clamps to the nearer end.
    const double part = 0.5 + std::atan2(first.y - first.x, first.x + first.y) / kQuarter;
    return std::clamp(part, 0.0, 1.0);
}

Interval rangeOver(const Arc& arc, const Vec2d& ab) {
    const Vec2d from = turnAt(arc.quarter, arc.from);
    const Vec2d to = turnAt(arc.quarter, arc.to);
    const double first = glm::dot(ab, from);
    const double last = glm::dot(ab, to);
    Interval range{std::min(first, last), std::max(first, last)};
    const double reach = glm::length(ab);
    if (cross(from, ab) >= 0.0 && cross(ab, to) >= 0.0) {
        range.upper = std::max(range.upper, reach);
    }
    if (cross(from, ab) <= 0.0 && cross(ab, to) <= 0.0) {
        range.lower = std::min(range.lower, -reach);
    }
    return range;
}

std::array<Vec2d, 4> hullOf(const Arc& arc) {
    const double length = arc.to - arc.from;
    const double beyond = 1.0 / std::cos(0.25 * length * kQuarter);
    return {turnAt(arc.quarter, arc.from), beyond * turnAt(arc.quarter, arc.from + 0.25 * length),
            beyond * turnAt(arc.quarter, arc.from + 0.75 * length), turnAt(arc.quarter, arc.to)};
}

namespace {

/// Badoiu and Clarkson 2003: steps towards the farthest direction, ever shorter ones, approach the centre of
/// the smallest ball about all. Axes come with the direction farthest from them, until `isEnough` says so.
template <class IsEnough>
void approachAxis(std::span<const Vec3d> directions, const IsEnough& isEnough) {
    std::array<Vec3d, 16> unit{};
    FLUXWALK_CHECK_LE(directions.size(), unit.size());
    Vec3d middle(0.0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        unit[i] = glm::normalize(directions[i]);
        middle += unit[i];
    }
    const std::span<const Vec3d> all(unit.data(), directions.size());
    constexpr int kSteps = 24;
    Vec3d center = middle / static_cast<double>(all.size());
    for (int step = 1; step <= kSteps; ++step) {
        const double length = glm::length(center);
        if (!(length > 1e-9)) {
            break;
        }
        const Vec3d axis = center / length;
        const Vec3d* farthest = &all.front();
        double distance = 0.0;
        for (const Vec3d& n : all) {
            // Distances, as cosines of small angles have lost their digits.
            const double d = glm::dot(n - axis, n - axis);
            if (d > distance) {
                distance = d;
                farthest = &n;
            }
        }
        if (isEnough(axis, *farthest)) {
            break;
        }
        center += (*farthest - center) / static_cast<double>(step + 1);
    }
}

}  // namespace

NormalCone coneAround(std::span<const Vec3d> directions, double enough) {
    NormalCone best{{0.0, 1.0, 0.0}, kPi};
    approachAxis(directions, [&](const Vec3d& axis, const Vec3d& farthest) {
        const double halfAngle = NormalCone::angleBetween(axis, farthest);
        if (halfAngle < best.halfAngle) {
            best = {axis, halfAngle};
        }
        return best.halfAngle <= enough;
    });
    // Only cones narrower than a half-space hold what their directions combine to.
    if (best.halfAngle >= 0.5 * kPi) {
        best.halfAngle = kPi;
    }
    return best;
}

bool isWithinCone(std::span<const Vec3d> directions, double halfAngle) {
    if (halfAngle >= 0.5 * kPi) {
        return coneAround(directions, halfAngle).halfAngle <= halfAngle;
    }
    const base::AngleLimit limit(halfAngle);
    bool isWithin = false;
    approachAxis(directions, [&](const Vec3d& axis, const Vec3d& farthest) {
        isWithin = limit.holds(axis, farthest);
        return isWithin;
    });
    return isWithin;
}

std::array<Vec2d, 2> parameterBox(const Region& region) {
    std::array<Vec2d, 2> box{region.corners[0], region.corners[0]};
    for (std::uint32_t i = 1; i < region.cornerCount; ++i) {
        box[0] = glm::min(box[0], region.corners[i]);
        box[1] = glm::max(box[1], region.corners[i]);
    }
    return box;
}

bool isParameterBox(const Region& region) {
    const auto& c = region.corners;
    return region.cornerCount == 4 && c[0].y == c[1].y && c[1].x == c[2].x && c[2].y == c[3].y &&
           c[3].x == c[0].x;
}

}  // namespace fluxwalk::surface
