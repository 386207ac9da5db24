#include "core/surface/torus_roots.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::surface {

namespace {

using base::Vec3d;

struct ValueAndSlope {
    double value = 0.0;
    double slope = 0.0;
};

// The root of a function that changes its sign between `lower` and `upper`: Newton's steps, and halving
// wherever these leave the bracket or do not shrink.
template <class Function>
double rootWithin(const Function& f, double lower, double upper, bool rises) {
    constexpr int kMostSteps = 200;
    double s = 0.5 * (lower + upper);
    double lastStep = upper - lower;
    for (int i = 0; i < kMostSteps; ++i) {
        const ValueAndSlope at = f(s);
        if (at.value == 0.0) {
            return s;
        }
        ((at.value > 0.0) == rises ? upper : lower) = s;
        const double step = at.value / at.slope;
        double next = s - step;
        if (!(next > lower && next < upper) || std::abs(step) > 0.5 * lastStep) {
            next = 0.5 * (lower + upper);
        }
        lastStep = std::abs(next - s);
        if (next == s || lastStep <= 1e-16) {
            return next;
        }
        s = next;
    }
    return s;
}

/// Ascending numbers, at most four.
struct Few {
    std::array<double, 5> at{};
    std::size_t count = 0;
    void add(double s) { at[count++] = s; }
};

/// Part of a line.
struct Range {
    double lower = 0.0;
    double upper = 0.0;
};

// Roots of a function between neighbouring `stops`, from one to the next of which it rises or falls only.
// Stretches outside `range` are left out; the others are searched whole, so that a root's rounding does not
// depend on the range.
template <class Function>
Few rootsBetween(const Function& f, const Few& stops, const Range& range) {
    Few roots;
    for (std::size_t i = 1; i < stops.count; ++i) {
        const double from = stops.at[i - 1];
        const double to = stops.at[i];
        if (to < range.lower || from > range.upper) {
            continue;
        }
        const bool startsBelow = f(from).value < 0.0;
        if (startsBelow != (f(to).value < 0.0)) {
            roots.add(rootWithin(f, from, to, startsBelow));
        }
    }
    return roots;
}

// `inner`, with the ends of an interval around it.
Few withEnds(double reach, const Few& inner) {
    Few stops;
    stops.add(-reach);
    for (std::size_t i = 0; i < inner.count; ++i) {
        stops.add(inner.at[i]);
    }
    stops.add(reach);
    return stops;
}

/// Ranges are this much wider than they need be, so that rounding cuts off nothing.
constexpr double kWider = 1e-9;

// The part of `range` between the planes that the torus lies between.
Range withinSlab(double tube, const Vec3d& foot, const Vec3d& along, Range range) {
    if (std::abs(along.y) < kWider) {
        return std::abs(foot.y) > tube * (1.0 + kWider) + 4.0 * kWider ? Range{0.0, -1.0} : range;
    }
    const double half = tube * (1.0 + kWider) / std::abs(along.y);
    const double middle = -foot.y / along.y;
    return {std::max(range.lower, middle - half), std::min(range.upper, middle + half)};
}

}  // namespace

std::array<double, 4> torusCrossings(double tube, const Vec3d& foot, const Vec3d& along, double from,
                                     double to) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::array<double, 4> crossings{kInf, kInf, kInf, kInf};
    const double squared = glm::dot(foot, foot);
    const double outer = 1.0 + tube;
    // Beyond the sphere around the torus by more than rounding, or not finite.
    const double reachSquared = outer * outer * (1.0 + 1e-12) - squared;
    if (!(reachSquared > 0.0)) {
        return crossings;
    }
    const double reach = std::sqrt(reachSquared);
    const Range range =
        withinSlab(tube, foot, along, {std::max(-reach, from - kWider), std::min(reach, to + kWider)});
    if (!(range.lower < range.upper)) {
        return crossings;
    }
    // The distance from the axis is largest at an end: is all of it in the hole?
    const double hole = (1.0 - tube) * (1.0 - kWider);
    const auto isInHole = [&](double s) {
        const double x = foot.x + s * along.x;
        const double z = foot.z + s * along.z;
        return x * x + z * z < hole * hole;
    };
    if (isInHole(range.lower) && isInHole(range.upper)) {
        return crossings;
    }
    // (|p|^2 + 1 - tube^2)^2 = 4 (x^2 + z^2) along the line is a quartic without cubic term, as the foot is
    // perpendicular to the line. A quarter of its derivative is s^3 + linear s + constant.
    const double flat = along.x * along.x + along.z * along.z;
    const double linear = squared + 1.0 - tube * tube - 2.0 * flat;
    const double constant = -2.0 * (foot.x * along.x + foot.z * along.z);
    const auto derivative = [&](double s) -> ValueAndSlope {
        return {(s * s + linear) * s + constant, 3.0 * s * s + linear};
    };
    // The torus as distance from the tube's centre line: it has the quartic's roots, and stays exact where
    // the tube is thin.
    const auto fromTube = [&](double s) -> ValueAndSlope {
        const Vec3d p = foot + s * along;
        const double radius = std::sqrt(p.x * p.x + p.z * p.z);
        const double h = radius - 1.0;
        const double outwards = radius > 0.0 ? (p.x * along.x + p.z * along.z) / radius : 0.0;
        return {h * h + p.y * p.y - tube * tube, 2.0 * (h * outwards + p.y * along.y)};
    };
    Few turns;
    if (linear < 0.0) {
        const double turn = std::sqrt(-linear / 3.0);
        if (turn < reach) {
            turns.add(-turn);
            turns.add(turn);
        }
    }
    const Few extremes = rootsBetween(derivative, withEnds(reach, turns), {-reach, reach});
    const Few roots = rootsBetween(fromTube, withEnds(reach, extremes), range);
    for (std::size_t i = 0; i < roots.count && i < crossings.size(); ++i) {
        crossings[i] = roots.at[i];
    }
    return crossings;
}

}  // namespace fluxwalk::surface
