#include "core/transport/form_factor.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::transport {

namespace {

using base::cross;
using base::dot;
using base::kLanes;
using base::kPi;
using base::Lanes3;
using base::LaneMask;
using base::splat;

/// Pairs farther apart than this many times the sum of their radii use 2 x 2 Gauss pairs: relative error below 1e-4.
constexpr double kFar = 4.0;
/// Pairs closer than this many times the larger radius use 4 x 4 receiver points.
constexpr double kNear = 2.0;

FLUXWALK_INLINE Lanes3 splat3(const Vec3d& v) { return {splat(v.x), splat(v.y), splat(v.z)}; }

FLUXWALK_INLINE double sumLanes(Lanes v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

// Lambert's formula for one point whose horizon cuts the polygon: clip, then sum over the edges.
double clippedPointFactor(const Vec3d& x, const Vec3d& n, const std::array<Vec3d, 4>& corners, std::uint32_t count) {
    std::array<Vec3d, 8> clipped;
    std::uint32_t m = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3d a = corners[i] - x;
        const Vec3d b = corners[(i + 1) % count] - x;
        const double ha = glm::dot(n, a);
        const double hb = glm::dot(n, b);
        if (ha >= 0.0) {
            clipped[m++] = a;
        }
        if ((ha < 0.0) != (hb < 0.0)) {
            clipped[m++] = a + (ha / (ha - hb)) * (b - a);
        }
    }
    double sum = 0.0;
    for (std::uint32_t i = 0; i < m; ++i) {
        const Vec3d& a = clipped[i];
        const Vec3d& b = clipped[(i + 1) % m];
        const Vec3d c = glm::cross(a, b);
        const double s = glm::length(c);
        if (s > 0.0) {
            sum -= glm::dot(n, c) * std::atan2(s, glm::dot(a, b)) / s;
        }
    }
    return std::max(0.0, sum / (2.0 * kPi));
}

// Factor of a planar polygon seen from eight points. Corners run counter-clockwise seen from its front.
FLUXWALK_INLINE Lanes polygonFactor(const Lanes3& x, const Lanes3& n, const std::array<Vec3d, 4>& corners,
                                    std::uint32_t count, double tolerance) {
    std::array<Lanes3, 4> d;
    LaneMask below = LaneMask{};
    LaneMask above = LaneMask{};
    for (std::uint32_t k = 0; k < count; ++k) {
        d[k] = splat3(corners[k]) - x;
        const Lanes h = dot(n, d[k]);
        below |= h < -tolerance;
        above |= h > tolerance;
    }
    Lanes sum = splat(0.0);
    for (std::uint32_t k = 0; k < count; ++k) {
        const Lanes3& a = d[k];
        const Lanes3& b = d[k + 1 == count ? 0 : k + 1];
        const Lanes3 c = cross(a, b);
        const Lanes s = base::sqrtLanes(dot(c, c));
        const Lanes angle = base::angleLanes(s, dot(a, b));
        sum -= dot(n, c) * angle / base::maxLanes(s, splat(1e-300));
    }
    Lanes factor = base::maxLanes(sum * (1.0 / (2.0 * kPi)), splat(0.0));
    factor = above ? factor : splat(0.0);
    const LaneMask straddling = above & below;
    if (base::anyLane(straddling)) {
        for (int i = 0; i < kLanes; ++i) {
            if (straddling[i] != 0) {
                factor[i] = clippedPointFactor({x.x[i], x.y[i], x.z[i]}, {n.x[i], n.y[i], n.z[i]}, corners, count);
            }
        }
    }
    return factor;
}

// Factor of an element seen from eight points, by the source's cubature points; `soften` (m2) keeps the kernel finite when near.
FLUXWALK_INLINE Lanes cubatureFactor(const Lanes3& x, const Lanes3& n, const ElementPoints& source, double soften) {
    Lanes sum = splat(0.0);
    for (int j = 0; j < 4; ++j) {
        const Lanes3 to = {source.position.x[j] - x.x, source.position.y[j] - x.y, source.position.z[j] - x.z};
        const Lanes r2 = dot(to, to);
        const Lanes here = dot(n, to);
        const Lanes there = -(source.normal.x[j] * to.x + source.normal.y[j] * to.y + source.normal.z[j] * to.z);
        const Lanes facing = base::maxLanes(here, splat(0.0)) * base::maxLanes(there, splat(0.0));
        sum += source.weight[j] * facing / base::maxLanes(r2 * (kPi * r2 + soften), splat(1e-300));
    }
    return base::minLanes(source.area * sum, splat(1.0));
}

struct OneWay {
    double mean = 0.0;
    double deviation = 0.0;
    double largest = 0.0;
};

FLUXWALK_INLINE OneWay summarize(Lanes factor, Lanes weight) {
    OneWay r;
    r.mean = sumLanes(weight * factor);
    double lowest = factor[0];
    double highest = factor[0];
    for (int i = 1; i < kLanes; ++i) {
        lowest = std::min(lowest, static_cast<double>(factor[i]));
        highest = std::max(highest, static_cast<double>(factor[i]));
    }
    r.largest = highest;
    r.deviation = std::max(highest - r.mean, r.mean - lowest);
    return r;
}

FLUXWALK_INLINE OneWay lookAt(const ElementPoints& receiver, const ElementPoints& source, bool far, bool near,
                              double tolerance, std::uint32_t& evaluations) {
    if (far || !source.isPlanar) {
        const double soften = far ? 0.0 : 0.25 * source.area;
        evaluations += 32;
        return summarize(cubatureFactor(receiver.position, receiver.normal, source, soften), receiver.weight);
    }
    evaluations += 8 * source.cornerCount;
    OneWay r = summarize(
        polygonFactor(receiver.position, receiver.normal, source.corners, source.cornerCount, tolerance), receiver.weight);
    if (near && receiver.isPlanar && r.largest > 0.0) {
        const DensePoints dense = makeDensePoints(receiver);
        double mean = 0.0;
        for (std::size_t block = 0; block < 2; ++block) {
            mean += sumLanes(dense.weight[block] * polygonFactor(dense.position[block], receiver.normal, source.corners,
                                                                 source.cornerCount, tolerance));
        }
        evaluations += 16 * source.cornerCount;
        r.mean = mean;
    }
    return r;
}

FLUXWALK_INLINE PairFactor pairFactor(const ElementPoints& a, const ElementPoints& b) {
    PairFactor result;
    const double distance = glm::distance(a.center, b.center);
    const double reach = a.radius + b.radius;
    const bool far = distance > kFar * reach;
    const bool near = distance - reach < kNear * std::max(a.radius, b.radius);
    const double tolerance = 1e-6 * (distance + reach);
    const OneWay atA = lookAt(a, b, far, near, tolerance, result.evaluations);
    const OneWay atB = lookAt(b, a, far, near, tolerance, result.evaluations);
    // Points of the smaller element see the larger one's exact factor vary least, so they weigh more; where only one element is
    // planar, its exact factor seen from the curved one counts alone.
    double weightA = b.radius * b.radius / (a.radius * a.radius + b.radius * b.radius);
    if (!far && a.isPlanar != b.isPlanar) {
        weightA = b.isPlanar ? 1.0 : 0.0;
    }
    result.coupling = weightA * a.area * atA.mean + (1.0 - weightA) * b.area * atB.mean;
    const double meanA = result.coupling / a.area;
    const double meanB = result.coupling / b.area;
    if (result.coupling <= 1e-3 * std::max(a.area * atA.largest, b.area * atB.largest)) {
        // (Nearly) all cubature points are below the horizon but a corner is not: a rough value that the oracle will not trust.
        constexpr double kCornerShare = 1.0 / 64.0;
        result.coupling = kCornerShare * std::min(a.area * std::max(atA.largest, 1e-30), b.area * std::max(atB.largest, 1e-30));
        if (atA.largest <= 0.0 && atB.largest <= 0.0) {
            result.coupling = 0.0;
        } else if (atA.largest <= 0.0 || atB.largest <= 0.0) {
            result.coupling = kCornerShare * std::max(a.area * atA.largest, b.area * atB.largest);
        }
        result.spreadA = result.spreadB = 1.0 / kCornerShare;
        return result;
    }
    result.spreadA = atA.deviation / meanA;
    result.spreadB = atB.deviation / meanB;
    return result;
}

[[gnu::target("avx2")]] PairFactor pairFactorAvx2(const ElementPoints& a, const ElementPoints& b) {
    return pairFactor(a, b);
}

PairFactor pairFactorBaseline(const ElementPoints& a, const ElementPoints& b) { return pairFactor(a, b); }

}  // namespace

PairFactor computePairFactor(const ElementPoints& a, const ElementPoints& b) {
    static const bool hasAvx2 = __builtin_cpu_supports("avx2") != 0;
    return hasAvx2 ? pairFactorAvx2(a, b) : pairFactorBaseline(a, b);
}

double computePointFactor(const Vec3d& x, const Vec3d& normal, const ElementPoints& source) {
    if (source.isPlanar) {
        return clippedPointFactor(x, normal, source.corners, source.cornerCount);
    }
    const Lanes factor = cubatureFactor(splat3(x), splat3(normal), source, 0.25 * source.area);
    return factor[0];
}

}  // namespace fluxwalk::transport
