#include "core/transport/isotropic_cluster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/photometry.h"

namespace fluxwalk::transport {

namespace {

using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using hierarchy::Shape;

/// Surfaces of random directions get max(0, cosine) times four of the mean share: 0 in one half of all cases,
/// evenly from 0 to 4 in the other. The mean deviation is 1/2 + 5/8.
constexpr double kOrientation = 2.0 * 1.125;
/// What is sent one way, against the mean of all ways: mean deviation of a plate with two sides.
constexpr double kSilhouette = 0.5;
/// Clusters up to this part of the larger end's size are fog.
constexpr float kFogSize = 0.5f;
/// Boxes of flat patches are taken for this part of their diagonal thick.
constexpr float kLeastThickness = 1e-3f;
/// The trees of emitters and of all else, side by side under the root.
constexpr std::size_t kMostOpen = rays::SpatialTree::kMaxDepth + 2;

double projectedArea(const Shape& cluster) {
    const auto radius = static_cast<double>(cluster.radius);
    return std::min(0.25 * static_cast<double>(cluster.exposedArea()), base::kPi * radius * radius);
}

// Spread over a cluster at `distance` from the other end.
double spreadOf(const Shape& cluster, double distance) {
    return kOrientation + 2.0 * std::min(1.0, static_cast<double>(cluster.radius) / distance);
}

PairFactor betweenClusters(const Shape& a, const Shape& b) {
    PairFactor result;
    result.evaluations = 1;
    const double between = static_cast<double>(glm::distance(a.center, b.center));
    const double distance = std::max({between, static_cast<double>(a.radius), static_cast<double>(b.radius)});
    if (!(distance > 0.0)) {
        return result;
    }
    result.coupling = projectedArea(a) * projectedArea(b) / (base::kPi * distance * distance);
    result.spreadA = spreadOf(a, distance) + kSilhouette;
    result.spreadB = spreadOf(b, distance) + kSilhouette;
    return result;
}

PairFactor withElement(const Hierarchy& h, NodeId clusterId, NodeId element) {
    const Shape& cluster = h.shape(clusterId);
    const Shape& shape = h.shape(element);
    const ElementPoints e = makeElementPoints(h, element);
    const double projected = projectedArea(cluster);
    const Vec3d center(cluster.center);
    const auto radius = static_cast<double>(cluster.radius);
    std::array<double, base::kLanes> values{};
    double mean = 0.0;
    for (int i = 0; i < base::kLanes; ++i) {
        const Vec3d x(e.position.x[i], e.position.y[i], e.position.z[i]);
        const Vec3d n(e.normal.x[i], e.normal.y[i], e.normal.z[i]);
        const Vec3d to = center - x;
        const double distance = std::max(glm::length(to), radius);
        double value = 0.0;
        if (distance > 0.0) {
            value = projected * std::max(0.0, glm::dot(n, to)) / (base::kPi * distance * distance * distance);
        }
        values[static_cast<std::size_t>(i)] = std::min(1.0, value);
        mean += e.weight[i] * values[static_cast<std::size_t>(i)];
    }
    PairFactor result;  // a: the cluster
    result.evaluations = base::kLanes;
    if (!(mean > 0.0)) {
        return result;
    }
    result.coupling = e.area * mean * static_cast<double>(shape.sampledArea() / shape.area);
    const double distance = std::max(glm::distance(center, e.center), radius);
    result.spreadA = spreadOf(cluster, distance);
    const LinearFit fit = fitLinear(e, values, mean);
    result.gradientB = fit.gradient;
    result.spreadB = fit.deviation / mean + kSilhouette;
    return result;
}

class FogWalk {
  public:
    FogWalk(const Hierarchy& h, NodeId a, NodeId b)
        : h_(h),
          ends_{topOf(a), topOf(b)},
          from_(h.shape(a).center),
          along_(h.shape(b).center - h.shape(a).center),
          fogSize_(kFogSize * std::max(h.shape(a).radius, h.shape(b).radius)) {}

    double depth() const {
        double sum = 0.0;
        std::array<NodeId, kMostOpen> stack{h_.root()};
        std::size_t open = 1;
        while (open > 0) {
            const NodeId id = stack[--open];
            const bool isEnd = id == ends_[0] || id == ends_[1];
            const double length = isEnd && h_.kind(id) != NodeKind::cluster ? 0.0 : lengthWithin(id);
            if (!(length > 0.0)) {
                continue;
            }
            const Shape& shape = h_.shape(id);
            const bool isPatch = h_.kind(id) != NodeKind::cluster;
            if (!isPatch && !isEnd && (shape.radius > fogSize_ || holdsEnd(id))) {
                stack[open++] = h_.child(id, 1);
                stack[open++] = h_.child(id, 0);
            } else {
                sum += 0.25 * static_cast<double>(shape.exposedArea()) / volumeOf(id) * length;
            }
        }
        return sum;
    }

  private:
    // The cluster, or the patch that an element is part of.
    NodeId topOf(NodeId id) const {
        while (h_.kind(id) != NodeKind::cluster && h_.parent(id) != NodeId::none &&
               h_.kind(h_.parent(id)) != NodeKind::cluster) {
            id = h_.parent(id);
        }
        return id;
    }

    bool holdsEnd(NodeId id) const {
        const std::uint32_t begin = h_.firstPatchBelow(id);
        const std::size_t count = h_.patchesBelow(id).size();
        return std::any_of(ends_.begin(), ends_.end(), [&](NodeId end) {
            const std::uint32_t first = h_.firstPatchBelow(end);
            return first >= begin && first - begin < count;
        });
    }

    hierarchy::Extent boxOf(NodeId id) const {
        hierarchy::Extent box = h_.extent(id);
        const float least = kLeastThickness * glm::length(box.upper - box.lower);
        const base::Vec3 grow =
            0.5f * glm::max(base::Vec3(least) - (box.upper - box.lower), base::Vec3(0.0f));
        return {box.lower - grow, box.upper + grow};
    }

    double volumeOf(NodeId id) const {
        const hierarchy::Extent box = boxOf(id);
        const base::Vec3d size(box.upper - box.lower);
        return std::max(size.x * size.y * size.z, 1e-30);
    }

    // Length of the line within a node's box, m.
    double lengthWithin(NodeId id) const {
        if (h_.shape(id).area <= 0.0f) {
            return 0.0;
        }
        const hierarchy::Extent box = boxOf(id);
        double enter = 0.0;
        double leave = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto d = static_cast<double>(along_[axis]);
            const double lower = static_cast<double>(box.lower[axis] - from_[axis]);
            const double upper = static_cast<double>(box.upper[axis] - from_[axis]);
            if (d == 0.0) {
                if (lower > 0.0 || upper < 0.0) {
                    return 0.0;
                }
                continue;
            }
            enter = std::max(enter, std::min(lower / d, upper / d));
            leave = std::min(leave, std::max(lower / d, upper / d));
        }
        return leave > enter ? (leave - enter) * static_cast<double>(glm::length(along_)) : 0.0;
    }

    const Hierarchy& h_;
    std::array<NodeId, 2> ends_;
    base::Vec3 from_;
    base::Vec3 along_;
    float fogSize_;
};

}  // namespace

PairFactor computeIsotropicFactor(const Hierarchy& hierarchy, NodeId a, NodeId b) {
    const bool isClusterA = hierarchy.kind(a) == NodeKind::cluster;
    if (isClusterA && hierarchy.kind(b) == NodeKind::cluster) {
        return betweenClusters(hierarchy.shape(a), hierarchy.shape(b));
    }
    return isClusterA ? withElement(hierarchy, a, b) : withElement(hierarchy, b, a).swapped();
}

float attenuate(const Hierarchy& hierarchy, NodeId a, NodeId b) {
    // The same bits in either order.
    if (hierarchy.key(a) > hierarchy.key(b)) {
        std::swap(a, b);
    }
    return static_cast<float>(std::exp(-FogWalk(hierarchy, a, b).depth()));
}

}  // namespace fluxwalk::transport
