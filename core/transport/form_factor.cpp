#include "core/transport/form_factor.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/type_ptr.hpp>

#include "core/base/photometry.h"
#include "core/transport/exact_form_factor.h"
#include "core/transport/form_factor_builds.h"

namespace fluxwalk::transport {

namespace {

using base::cross;
using base::dot;
using base::kLanes;
using base::kPi;
using base::LaneMask;
using base::Lanes3;
using base::splat;

/// Pairs farther apart than this many times the sum of their radii use 2 x 2 Gauss pairs: relative error
/// below 1e-4.
constexpr double kFar = 4.0;
/// Pairs closer than this many times the larger radius use 4 x 4 receiver points.
constexpr double kNear = 2.0;

FLUXWALK_INLINE Lanes3 splat3(const Vec3d& v) {
    return {splat(v.x), splat(v.y), splat(v.z)};
}

FLUXWALK_INLINE double sumLanes(Lanes v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

// Lambert's formula for one point whose horizon cuts the polygon: clip, then sum over the edges.
double clippedPointFactor(const Vec3d& x, const Vec3d& n, const std::array<Vec3d, 8>& corners,
                          std::uint32_t count) {
    std::array<Vec3d, 16> clipped;
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

// Factor of what a closed polygon bounds, seen from eight points that all of it faces: it depends on the
// contour alone, so the polygon need not be planar. Corners run counter-clockwise seen from the front.
FLUXWALK_INLINE Lanes polygonFactor(const Lanes3& x, const Lanes3& n, const std::array<Vec3d, 8>& corners,
                                    std::uint32_t count, double tolerance) {
    std::array<Lanes3, 8> d;
    auto below = LaneMask{};
    auto above = LaneMask{};
    for (std::uint32_t k = 0; k < count; ++k) {
        d[k] = splat3(corners[k]) - x;
        const Lanes h = dot(n, d[k]);
        below |= h < splat(-tolerance);
        above |= h > splat(tolerance);
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
    factor = base::select(above, factor, splat(0.0));
    const LaneMask straddling = above & below;
    if (base::anyLane(straddling)) {
        for (int i = 0; i < kLanes; ++i) {
            if (straddling[i]) {
                factor.set(i, clippedPointFactor({x.x[i], x.y[i], x.z[i]}, {n.x[i], n.y[i], n.z[i]}, corners,
                                                 count));
            }
        }
    }
    return factor;
}

// Factor of an element seen from eight points, by the source's cubature points. Each stands for a disc of
// `part` m2: K / (1 + K) with K = part cos cos / (pi r2), which is exact on the disc's axis and leaves the
// kernel alone where it is finite by itself, as between neighbours on a hollow surface.
FLUXWALK_INLINE Lanes cubatureFactor(const Lanes3& x, const Lanes3& n, const ElementPoints& source,
                                     double part) {
    Lanes sum = splat(0.0);
    for (int j = 0; j < 4; ++j) {
        const Lanes3 to = {source.position.x[j] - x.x, source.position.y[j] - x.y,
                           source.position.z[j] - x.z};
        const Lanes r2 = dot(to, to);
        const Lanes here = dot(n, to);
        const Lanes there =
            -(source.normal.x[j] * to.x + source.normal.y[j] * to.y + source.normal.z[j] * to.z);
        const Lanes facing = base::maxLanes(here, splat(0.0)) * base::maxLanes(there, splat(0.0));
        sum += source.weight[j] * facing / base::maxLanes(kPi * r2 * r2 + part * facing, splat(1e-300));
    }
    return base::minLanes(source.area * sum, splat(1.0));
}

// Which of eight points all of a curved source faces.
FLUXWALK_INLINE LaneMask facesAll(const Lanes3& x, const ElementPoints& source) {
    LaneMask all = ~LaneMask{};
    for (int j = 0; j < kLanes; ++j) {
        const Lanes3 to = {source.position.x[j] - x.x, source.position.y[j] - x.y,
                           source.position.z[j] - x.z};
        const Lanes there =
            -(source.normal.x[j] * to.x + source.normal.y[j] * to.y + source.normal.z[j] * to.z);
        all &= (there > splat(0.0)) & (there * there > kLeastFacing * kLeastFacing * dot(to, to));
    }
    return all;
}

// Factor of an element that is not far: by its contour where all of it faces the point, else by its cubature
// points.
FLUXWALK_INLINE Lanes nearFactor(const Lanes3& x, const Lanes3& n, const ElementPoints& source,
                                 double tolerance, std::uint32_t& evaluations) {
    LaneMask facing = ~LaneMask{};
    Lanes factor = splat(0.0);
    if (!source.isFlat) {
        facing = facesAll(x, source);
        factor = cubatureFactor(x, n, source, 0.25 * source.area);
        evaluations += 32;
    }
    if (base::anyLane(facing)) {
        const Lanes whole = polygonFactor(x, n, source.contour, source.contourCount, tolerance);
        factor = base::select(facing, whole, factor);
        evaluations += 8 * source.contourCount;
    }
    return factor;
}

struct alignas(base::kLanesAlignment) OneWay {
    Lanes values{};
    double mean = 0.0;
    double largest = 0.0;
};

FLUXWALK_INLINE OneWay summarize(Lanes factor, Lanes weight) {
    OneWay r;
    r.values = factor;
    r.mean = sumLanes(weight * factor);
    for (int i = 0; i < kLanes; ++i) {
        r.largest = std::max(r.largest, static_cast<double>(factor[i]));
    }
    return r;
}

FLUXWALK_INLINE OneWay lookAt(const ElementPoints& receiver, const ElementPoints& source, bool far, bool near,
                              double tolerance, std::uint32_t& evaluations) {
    if (far) {
        evaluations += 32;
        return summarize(cubatureFactor(receiver.position, receiver.normal, source, 0.0), receiver.weight);
    }
    OneWay r = summarize(nearFactor(receiver.position, receiver.normal, source, tolerance, evaluations),
                         receiver.weight);
    if (near && receiver.isPlanar && source.isFlat && r.largest > 0.0) {
        const DensePoints dense = makeDensePoints(receiver);
        double mean = 0.0;
        for (std::size_t block = 0; block < 2; ++block) {
            mean +=
                sumLanes(dense.weight[block] * polygonFactor(dense.position[block], receiver.normal,
                                                             source.contour, source.contourCount, tolerance));
        }
        evaluations += 16 * source.contourCount;
        r.mean = mean;
    }
    return r;
}

/// Both views of a pair, before they are combined.
struct BothWays {
    OneWay atA;
    OneWay atB;
    bool far = false;
    std::uint32_t evaluations = 0;
};

FLUXWALK_INLINE BothWays viewBoth(const ElementPoints& a, const ElementPoints& b) {
    BothWays result;
    const double distance = glm::distance(a.center, b.center);
    const double reach = a.radius + b.radius;
    result.far = distance > kFar * reach;
    const bool near = distance - reach < kNear * std::max(a.radius, b.radius);
    const double tolerance = 1e-6 * (distance + reach);
    result.atA = lookAt(a, b, result.far, near, tolerance, result.evaluations);
    result.atB = lookAt(b, a, result.far, near, tolerance, result.evaluations);
    return result;
}

[[gnu::target("avx2")]] BothWays viewBothAvx2(const ElementPoints& a, const ElementPoints& b) {
    return viewBoth(a, b);
}

BothWays viewBothBaseline(const ElementPoints& a, const ElementPoints& b) {
    return viewBoth(a, b);
}

FLUXWALK_INLINE Lanes pointFactors(const Lanes3& x, const Lanes3& normal, const ElementPoints& source) {
    std::uint32_t evaluations = 0;
    return nearFactor(x, normal, source, 1e-6 * source.radius, evaluations);
}

[[gnu::target("avx2")]] Lanes pointFactorsAvx2(const Lanes3& x, const Lanes3& normal,
                                               const ElementPoints& source) {
    return pointFactors(x, normal, source);
}

Lanes pointFactorsBaseline(const Lanes3& x, const Lanes3& normal, const ElementPoints& source) {
    return pointFactors(x, normal, source);
}

bool hasAvx2() {
    static const bool kHas = __builtin_cpu_supports("avx2") != 0;
    return kHas;
}

std::array<double, kLanes> toArray(Lanes v) {
    std::array<double, kLanes> out{};
    for (int i = 0; i < kLanes; ++i) {
        out[static_cast<std::size_t>(i)] = v[i];
    }
    return out;
}

}  // namespace

ViewWeights weighViews(const ElementPoints& a, const ElementPoints& b, bool isNear) {
    if (isNear && a.isFlat != b.isFlat) {
        return b.isFlat ? ViewWeights{1.0, 0.0} : ViewWeights{0.0, 1.0};
    }
    const double both = a.radius * a.radius + b.radius * b.radius;
    return {b.radius * b.radius / both, a.radius * a.radius / both};
}

LinearFit fitLinear(const ElementPoints& element, const std::array<double, kLanes>& values, double mean) {
    LinearFit fit;
    fit.mean = mean;
    fit.largest = *std::max_element(values.begin(), values.end());
    const std::array<base::Vec2d, kLanes>& local = localPointCoordinates(element.cornerCount);
    // Least squares over the cubature points; their coordinates are symmetric about 0.
    constexpr std::size_t kCubaturePoints = 4;
    double ss = 0.0;
    double st = 0.0;
    double tt = 0.0;
    double sf = 0.0;
    double tf = 0.0;
    for (std::size_t i = 0; i < kCubaturePoints; ++i) {
        ss += local[i].x * local[i].x;
        st += local[i].x * local[i].y;
        tt += local[i].y * local[i].y;
        sf += local[i].x * values[i];
        tf += local[i].y * values[i];
    }
    const base::Vec2d slope = base::Vec2d(tt * sf - st * tf, ss * tf - st * sf) / (ss * tt - st * st);
    for (std::size_t i = 0; i < local.size(); ++i) {
        fit.deviation = std::max(fit.deviation, std::abs(values[i] - mean - glm::dot(slope, local[i])));
    }
    fit.gradient = mean > 0.0 ? slope / mean : base::Vec2d(0.0);
    return fit;
}

namespace {

PairFactor combine(const ElementPoints& a, const ElementPoints& b, const BothWays& views,
                   const std::optional<double>& known = std::nullopt) {
    const OneWay& atA = views.atA;
    const OneWay& atB = views.atB;
    PairFactor result;
    result.evaluations = views.evaluations;
    const ViewWeights weights = weighViews(a, b, !views.far);
    result.coupling = weights.atA * (a.area * atA.mean) + weights.atB * (b.area * atB.mean);
    const bool touch = glm::distance(a.center, b.center) < a.radius + b.radius;
    if (touch && a.isPlanar && b.isPlanar && atA.largest > 0.0 && atB.largest > 0.0) {
        // In one order, as rounding depends on it.
        const bool isFirst =
            std::lexicographical_compare(glm::value_ptr(a.center), glm::value_ptr(a.center) + 3,
                                         glm::value_ptr(b.center), glm::value_ptr(b.center) + 3);
        const ElementPoints& one = isFirst ? a : b;
        const ElementPoints& other = isFirst ? b : a;
        result.coupling = polygonCoupling(std::span(one.corners.data(), one.cornerCount),
                                          std::span(other.corners.data(), other.cornerCount));
    }
    if (known) {
        result.coupling = *known;
    }
    const double highest = std::max(a.area * atA.largest, b.area * atB.largest);
    if (highest <= 0.0) {
        return result;
    }
    if (result.coupling <= 1e-3 * highest) {
        // (Nearly) all cubature points are below the horizon but a corner is not: a rough value that the
        // oracle will not trust.
        constexpr double kCornerShare = 1.0 / 64.0;
        result.coupling = kCornerShare * highest;
        result.spreadA = result.spreadB = 1.0 / kCornerShare;
        return result;
    }
    const double meanA = result.coupling / a.area;
    const double meanB = result.coupling / b.area;
    const LinearFit fitA = fitLinear(a, toArray(atA.values), meanA);
    const LinearFit fitB = fitLinear(b, toArray(atB.values), meanB);
    result.gradientA = fitA.gradient;
    result.gradientB = fitB.gradient;
    result.spreadA = fitA.deviation / meanA;
    result.spreadB = fitB.deviation / meanB;
    return result;
}

}  // namespace

PairFactor computePairFactorBaseline(const ElementPoints& a, const ElementPoints& b) {
    return combine(a, b, viewBothBaseline(a, b));
}

PairFactor computePairFactorAvx2(const ElementPoints& a, const ElementPoints& b) {
    return combine(a, b, viewBothAvx2(a, b));
}

PairFactor computePairFactor(const ElementPoints& a, const ElementPoints& b,
                             const std::optional<double>& coupling) {
    return combine(a, b, hasAvx2() ? viewBothAvx2(a, b) : viewBothBaseline(a, b), coupling);
}

Lanes computePointFactors(const Lanes3& x, const Lanes3& normal, const ElementPoints& source) {
    return hasAvx2() ? pointFactorsAvx2(x, normal, source) : pointFactorsBaseline(x, normal, source);
}

double computePointFactor(const Vec3d& x, const Vec3d& normal, const ElementPoints& source) {
    if (source.isFlat) {
        return clippedPointFactor(x, normal, source.contour, source.contourCount);
    }
    const double tolerance = 1e-6 * (glm::distance(x, source.center) + source.radius);
    std::uint32_t evaluations = 0;
    return nearFactor(splat3(x), splat3(normal), source, tolerance, evaluations)[0];
}

}  // namespace fluxwalk::transport
