#include "core/transport/cluster_factor.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/transport/cluster_points.h"
#include "core/transport/exposed_part.h"

namespace fluxwalk::transport {

namespace {

using base::dot;
using base::kLanes;
using base::Lanes3;
using base::splat;

using Values = std::array<Lanes, kClusterBlocks>;

FLUXWALK_INLINE Lanes3 splatLane(const Lanes3& v, int lane) {
    return {splat(v.x[lane]), splat(v.y[lane]), splat(v.z[lane])};
}

// What eight points see of the points of b. A point stands for a disc, so that near ones stay finite
// (cubatureFactor in form_factor.cpp); all together fill no more than the hemisphere.
FLUXWALK_INLINE Lanes receive(const Lanes3& x, const Lanes3& n, const ClusterPoints& b) {
    Lanes sum = splat(0.0);
    for (unsigned j = 0; j < kClusterPoints; ++j) {
        const unsigned block = j / kLanes;
        const int lane = static_cast<int>(j % kLanes);
        const Lanes3 to = splatLane(b.position[block], lane) - x;
        const Lanes3 m = splatLane(b.normal[block], lane);
        const double area = b.area[block][lane];
        const Lanes r2 = dot(to, to);
        const Lanes facing = base::maxLanes(dot(n, to), splat(0.0)) * base::maxLanes(-dot(m, to), splat(0.0));
        sum += area * facing / base::maxLanes(base::kPi * r2 * r2 + area * facing, splat(1e-300));
    }
    return base::minLanes(sum, splat(1.0));
}

struct BothClusters {
    Values atA{};
    Values atB{};
};

FLUXWALK_INLINE BothClusters exchange(const ClusterPoints& a, const ClusterPoints& b) {
    BothClusters result;
    for (unsigned k = 0; k < kClusterBlocks; ++k) {
        result.atA[k] = receive(a.position[k], a.normal[k], b);
        result.atB[k] = receive(b.position[k], b.normal[k], a);
    }
    return result;
}

[[gnu::target("avx2")]] BothClusters exchangeAvx2(const ClusterPoints& a, const ClusterPoints& b) {
    return exchange(a, b);
}

BothClusters exchangeBaseline(const ClusterPoints& a, const ClusterPoints& b) {
    return exchange(a, b);
}

[[gnu::target("avx2")]] Lanes receiveAvx2(const Lanes3& x, const Lanes3& n, const ClusterPoints& b) {
    return receive(x, n, b);
}

Lanes receiveBaseline(const Lanes3& x, const Lanes3& n, const ClusterPoints& b) {
    return receive(x, n, b);
}

bool hasAvx2() {
    static const bool kHas = __builtin_cpu_supports("avx2") != 0;
    return kHas;
}

/// What the points of a cluster receive, against what its patches' shares give them.
struct Received {
    double power = 0.0;   ///< m2
    double shares = 0.0;  ///< sum over the points, as sumShares() over the patches
    double spread = 0.0;
};

Received summarize(const hierarchy::Hierarchy& h, const ClusterPoints& points, const Values& values,
                   const Ball& other) {
    Received r;
    std::array<double, kClusterPoints> share{};
    for (unsigned k = 0; k < kClusterPoints; ++k) {
        const unsigned block = k / kLanes;
        const int lane = static_cast<int>(k % kLanes);
        share[k] = static_cast<double>(computeShare(h.patchTable(), points.patch[k], other));
        r.power += points.area[block][lane] * values[block][lane];
        r.shares += points.area[block][lane] * share[k];
    }
    if (!(r.power > 0.0)) {
        return r;
    }
    const double perShare = r.shares > 0.0 ? r.power / r.shares : 0.0;
    double off = 0.0;
    for (unsigned k = 0; k < kClusterPoints; ++k) {
        const unsigned block = k / kLanes;
        const int lane = static_cast<int>(k % kLanes);
        off += points.area[block][lane] * std::abs(values[block][lane] - perShare * share[k]);
    }
    r.spread = 2.0 * off / r.power;
    return r;
}

// How much the sum of the shares of all patches differs from what the few points say of it. Where few points
// had a share, that is not stretched to many times what they show.
double correct(double shares, const Received& received) {
    constexpr double kMost = 4.0;
    return received.shares > 0.0 ? std::min(shares / received.shares, kMost) : 1.0;
}

// Coupling with which every patch would see the whole ball about the other end glow: no more can arrive.
// Without this limit, few points in a crowd of patches could let them light each other up without end.
double limitOf(double shares, const Ball& other) {
    const auto radius = static_cast<double>(other.radius);
    return shares * radius * radius;
}

// What the points of a cluster leave unknown of the coupling itself, of their spread (twice a mean
// deviation): 2.6 standard errors of the mean of 32 points, which 99 % of normal errors keep.
constexpr double kUnknown = 0.3;

PairFactor betweenClusters(const hierarchy::Hierarchy& h, NodeId a, NodeId b) {
    const ClusterPoints pointsA = makeClusterPoints(h, a);
    const ClusterPoints pointsB = makeClusterPoints(h, b);
    const BothClusters both = hasAvx2() ? exchangeAvx2(pointsA, pointsB) : exchangeBaseline(pointsA, pointsB);
    const Ball ballA = findBall(h, b, a);
    const Ball ballB = findBall(h, a, b);
    const Received atA = summarize(h, pointsA, both.atA, ballB);
    const Received atB = summarize(h, pointsB, both.atB, ballA);
    PairFactor result;
    result.evaluations = 2 * kClusterPoints * kClusterPoints;
    const auto sharesA = static_cast<double>(sumShares(h, a, ballB));
    const auto sharesB = static_cast<double>(sumShares(h, b, ballA));
    result.coupling = std::min({0.5 * (atA.power + atB.power) * correct(sharesA, atA) * correct(sharesB, atB),
                                limitOf(sharesA, ballB), limitOf(sharesB, ballA)});
    result.spreadA = atA.spread + kUnknown * atB.spread;
    result.spreadB = atB.spread + kUnknown * atA.spread;
    return result;
}

// Gradient and spread at the element, end b, of what its points receive; `unknown` is added to the spread.
void describeElementEnd(const ElementPoints& e, const Lanes& received, double unknown, PairFactor& result) {
    std::array<double, kLanes> values{};
    double mean = 0.0;
    for (int i = 0; i < kLanes; ++i) {
        values[static_cast<std::size_t>(i)] = received[i];
        mean += e.weight[i] * received[i];
    }
    if (!(mean > 0.0)) {
        result.spreadB = 2.0;
        return;
    }
    const LinearFit fit = fitLinear(e, values, mean);
    result.gradientB = fit.gradient;
    result.spreadB = fit.deviation / mean + unknown;
}

/// Of clusters of so few patches each counts by itself: about as dear as points of them all, and as exact as
/// pairs of elements.
constexpr std::size_t kFewPatches = 8;

// Part of what a patch exchanges with an element that its exposed cells take.
double exposedShare(const hierarchy::Hierarchy& h, NodeId patch, const ElementPoints& e) {
    if (!isPartlyHidden(h.shape(patch))) {
        return 1.0;
    }
    const auto kernel = [&](const SurfaceSample& p) { return computePointFactor(p.position, p.normal, e); };
    return findExposedPart(h, patch, kernel).share;
}

/// A patch of a cluster and what it exchanges with an element.
struct PatchView {
    double power = 0.0;   ///< m2
    double shares = 0.0;  ///< its share of what the cluster gets, times its area
    Lanes values{};       ///< factors at its points, and their weights
    Lanes weight{};
};

// Twice the mean deviation of what the patches' points receive from what the shares give their patches.
double spreadOf(std::span<const PatchView> patches, double power, double shares) {
    const double perShare = shares > 0.0 ? power / shares : 0.0;
    double off = 0.0;
    for (const PatchView& patch : patches) {
        const double given = perShare * patch.shares;
        double mean = 0.0;
        for (int k = 0; k < kLanes; ++k) {
            mean += patch.weight[k] * patch.values[k];
        }
        if (!(mean > 0.0)) {
            off += std::abs(patch.power - given);
            continue;
        }
        // The points' values tell how the patch's power is spread over it.
        for (int k = 0; k < kLanes; ++k) {
            off += patch.weight[k] * std::abs(patch.power * patch.values[k] / mean - given);
        }
    }
    return power > 0.0 ? 2.0 * off / power : 0.0;
}

PairFactor withFewPatches(const hierarchy::Hierarchy& h, NodeId cluster, NodeId element) {
    const ElementPoints e = makeElementPoints(h, element);
    const Ball ball = findBall(h, cluster, element);
    const std::span<const NodeId> below = h.patchesBelow(cluster);
    std::array<PatchView, kFewPatches> patches;
    PairFactor result;  // a: the cluster
    double power = 0.0;
    double shares = 0.0;
    Lanes atElement = splat(0.0);
    for (std::size_t i = 0; i < below.size(); ++i) {
        PatchView& patch = patches[i];
        patch.shares =
            static_cast<double>(computeShare(h.patchTable(), h.firstPatchBelow(cluster) + i, ball) *
                                h.shape(below[i]).exposedArea());
        shares += patch.shares;
        const ElementPoints p = makeElementPoints(h, below[i]);
        const PairFactor pair = computePairFactor(p, e);
        result.evaluations += pair.evaluations;
        if (pair.coupling > 0.0) {
            const double exposed = exposedShare(h, below[i], e);
            patch.power = exposed * pair.coupling;
            patch.values = computePointFactors(p.position, p.normal, e);
            patch.weight = p.weight;
            power += patch.power;
            atElement += exposed * computePointFactors(e.position, e.normal, p);
            result.evaluations += kLanes * (p.contourCount + e.contourCount);
        }
    }
    if (!(power > 0.0)) {
        return result;
    }
    result.coupling = power * static_cast<double>(h.shape(element).sampledArea() / h.shape(element).area);
    result.spreadA = spreadOf({patches.data(), below.size()}, power, shares);
    describeElementEnd(e, atElement, 0.0, result);
    return result;
}

PairFactor withElement(const hierarchy::Hierarchy& h, NodeId cluster, NodeId element) {
    if (h.patchesBelow(cluster).size() <= kFewPatches) {
        return withFewPatches(h, cluster, element);
    }
    const ClusterPoints points = makeClusterPoints(h, cluster);
    const ElementPoints e = makeElementPoints(h, element);
    Values values{};
    for (unsigned k = 0; k < kClusterBlocks; ++k) {
        values[k] = computePointFactors(points.position[k], points.normal[k], e);
    }
    const Ball ball = findBall(h, cluster, element);
    const Received received = summarize(h, points, values, ball);
    PairFactor result;  // a: the cluster
    result.evaluations = kClusterPoints * (e.contourCount + kLanes);
    if (!(received.power > 0.0)) {
        return result;
    }
    const auto shares = static_cast<double>(sumShares(h, cluster, ball));
    result.coupling = received.power * correct(shares, received) *
                      static_cast<double>(h.shape(element).sampledArea() / h.shape(element).area);
    result.spreadA = received.spread;
    const Lanes atElement =
        hasAvx2() ? receiveAvx2(e.position, e.normal, points) : receiveBaseline(e.position, e.normal, points);
    describeElementEnd(e, atElement, kUnknown * received.spread, result);
    return result;
}

}  // namespace

Ball findBall(const hierarchy::Hierarchy& hierarchy, NodeId cluster, NodeId other) {
    const hierarchy::Shape& shape = hierarchy.shape(other);
    const Ball sphere{shape.center, shape.radius};
    if (shape.cornerCount == 0 || !shape.isPlanar) {
        return sphere;
    }
    const Vec3d eye(hierarchy.shape(cluster).center);
    Vec3d sum(0.0);
    for (std::uint32_t i = 0; i < shape.cornerCount; ++i) {
        const Vec3d a = Vec3d(shape.corners[i]) - eye;
        const Vec3d b = Vec3d(shape.corners[(i + 1) % shape.cornerCount]) - eye;
        const Vec3d c = glm::cross(b, a);
        const double s = glm::length(c);
        if (s > 0.0) {
            sum += c * (std::atan2(s, glm::dot(a, b)) / s);
        }
    }
    const double length = glm::length(sum);
    // Half of that is pi times the squared sine of a cone with the same light.
    const double sine = std::sqrt(std::min(1.0, 0.5 * length / base::kPi));
    const Vec3d toward = length > 0.0 ? sum / length : Vec3d(0.0);
    const double facing = -glm::dot(toward, Vec3d(shape.axis));
    if (!(facing > 1e-3) || !(sine > 1e-6)) {
        return sphere;
    }
    const double radius = std::sqrt(static_cast<double>(shape.area) * facing / base::kPi);
    return {base::Vec3(eye + radius / sine * toward), static_cast<float>(radius)};
}

PairFactor computeClusterFactor(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b) {
    const bool isClusterA = hierarchy.kind(a) == hierarchy::NodeKind::cluster;
    const bool isClusterB = hierarchy.kind(b) == hierarchy::NodeKind::cluster;
    if (isClusterA && isClusterB) {
        return betweenClusters(hierarchy, a, b);
    }
    return isClusterA ? withElement(hierarchy, a, b) : withElement(hierarchy, b, a).swapped();
}

}  // namespace fluxwalk::transport
