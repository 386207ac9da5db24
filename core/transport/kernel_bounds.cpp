#include "core/transport/kernel_bounds.h"

#include <algorithm>
#include <cmath>

#include "core/base/normal_cone.h"
#include "core/base/photometry.h"

namespace fluxwalk::transport {

namespace {

using base::kPi;
using base::NormalCone;
using base::Vec3d;
using hierarchy::Shape;

/// Shapes are stored as float: their rounding, relative to lengths and in radians.
constexpr double kRounding = 2e-6;

/// An end as the hull of points, each with a ball about it.
struct Hull {
    std::array<Vec3d, 4> points{};
    std::uint32_t count = 1;
    double ball = 0.0;
    Vec3d axis{};
    double halfAngle = 0.0;
};

Hull hullOf(const Shape& shape) {
    Hull hull;
    hull.axis = glm::normalize(Vec3d(shape.axis));
    if (shape.isPlanar && shape.cornerCount > 0) {
        hull.count = shape.cornerCount;
        for (std::uint32_t i = 0; i < hull.count; ++i) {
            hull.points[i] = Vec3d(shape.corners[i]);
        }
        return hull;
    }
    hull.points[0] = Vec3d(shape.center);
    hull.ball = static_cast<double>(shape.radius);
    hull.halfAngle = static_cast<double>(shape.halfAngle);
    return hull;
}

/// The vectors from one end to the other: their lengths, and a cone that holds their directions.
struct Vectors {
    std::array<Vec3d, 16> directions{};  ///< between the points
    std::uint32_t count = 0;
    double shortest = 0.0;
    double longest = 0.0;
    double turn = 0.0;  ///< that balls add to the directions between points, radians
    NormalCone cone;
};

// All vectors are convex combinations of those between points, plus one within the balls.
Vectors vectorsBetween(const Hull& from, const Hull& to) {
    Vectors v;
    Vec3d sum(0.0);
    for (std::uint32_t i = 0; i < from.count; ++i) {
        for (std::uint32_t j = 0; j < to.count; ++j) {
            v.directions[v.count] = to.points[j] - from.points[i];
            sum += v.directions[v.count++];
        }
    }
    v.cone.axis = glm::normalize(sum);
    v.shortest = glm::length(sum);
    for (std::uint32_t i = 0; i < v.count; ++i) {
        v.shortest = std::min(v.shortest, glm::dot(v.directions[i], v.cone.axis));
        v.longest = std::max(v.longest, glm::length(v.directions[i]));
    }
    const double ball = from.ball + to.ball + kRounding * v.longest;
    if (v.shortest <= ball) {
        v.shortest = 0.0;
        return v;
    }
    v.turn = std::asin(ball / v.shortest) + kRounding;
    for (std::uint32_t i = 0; i < v.count; ++i) {
        v.directions[i] = glm::normalize(v.directions[i]);
        v.cone.halfAngle =
            std::max(v.cone.halfAngle, NormalCone::angleBetween(v.directions[i], v.cone.axis) + v.turn);
    }
    v.shortest -= ball;
    v.longest += ball;
    return v;
}

struct Interval {
    double lower = 0.0;
    double upper = 1.0;
};

// Of the cosines between an end's normals and the vectors that leave it (`sign` 1) or reach it (-1).
Interval boundCosine(const Hull& end, const Vectors& v, double sign) {
    // Directions within an angle below pi / 2 of an axis are convex: the farthest is one between points.
    double farthest = 0.0;
    for (std::uint32_t i = 0; i < v.count; ++i) {
        farthest = std::max(farthest, NormalCone::angleBetween(end.axis, sign * v.directions[i]));
    }
    farthest += v.turn + end.halfAngle;
    const double nearest =
        NormalCone::angleBetween(end.axis, sign * v.cone.axis) - v.cone.halfAngle - end.halfAngle;
    Interval cosine;
    cosine.lower = farthest < 0.5 * kPi ? std::cos(farthest) : 0.0;
    cosine.upper = nearest < 0.5 * kPi ? std::cos(std::max(0.0, nearest)) : 0.0;
    return cosine;
}

}  // namespace

FactorBounds boundPointFactor(const Shape& receiver, const Shape& source) {
    const Hull from = hullOf(receiver);
    const Hull to = hullOf(source);
    const Vectors v = vectorsBetween(from, to);
    if (v.shortest <= 0.0) {
        return {};
    }
    const Interval here = boundCosine(from, v, 1.0);
    const Interval there = boundCosine(to, v, -1.0);
    const auto area = static_cast<double>(source.area);
    FactorBounds bounds;
    bounds.lower = area * here.lower * there.lower / (kPi * v.longest * v.longest);
    bounds.upper = std::min(1.0, area * here.upper * there.upper / (kPi * v.shortest * v.shortest));
    // Nothing subtends more than the sphere around it.
    double nearest = glm::distance(Vec3d(source.center), Vec3d(receiver.center));
    nearest -= static_cast<double>(receiver.radius) * (1.0 + kRounding);
    const double sphere = static_cast<double>(source.radius) * (1.0 + kRounding);
    if (nearest > sphere) {
        const double sine = sphere / nearest;
        bounds.upper = std::min(bounds.upper, here.upper * 2.0 * (1.0 - std::sqrt(1.0 - sine * sine)));
    }
    // Areas are stored as float too.
    bounds.lower *= 1.0 - kRounding;
    bounds.upper *= 1.0 + kRounding;
    return bounds;
}

}  // namespace fluxwalk::transport
