#include "core/transport/cluster_points.h"

#include <algorithm>

#include "core/base/random.h"

namespace fluxwalk::transport {

ClusterSampler::ClusterSampler(const hierarchy::Hierarchy& hierarchy, NodeId cluster)
    : hierarchy_(hierarchy),
      begin_(hierarchy.firstPatchBelow(cluster)),
      end_(begin_ + static_cast<std::uint32_t>(hierarchy.patchesBelow(cluster).size())),
      before_(hierarchy.sampledAreaBefore(begin_)),
      area_(hierarchy.sampledAreaBefore(end_) - before_) {}

ClusterSampler::Place ClusterSampler::at(double place, double across) const {
    const double wanted = before_ + place * area_;
    // Without branches, which could not be foretold.
    std::uint32_t first = begin_;
    for (std::uint32_t count = end_ - begin_; count > 1;) {
        const std::uint32_t half = count / 2;
        first += hierarchy_.sampledAreaBefore(first + half) <= wanted ? half : 0;
        count -= half;
    }
    const double below = hierarchy_.sampledAreaBefore(first);
    const double size = hierarchy_.sampledAreaBefore(first + 1) - below;
    const double along = size > 0.0 ? std::clamp((wanted - below) / size, 0.0, 1.0 - 0x1.0p-30) : 0.5;
    const ElementSampler sampler(hierarchy_, hierarchy_.patches()[first]);
    Place result{first, sampler.inExposed({along, across})};
    result.point.measure /= sampler.meanMeasure();
    result.point.local = base::Vec2d(0.0);
    return result;
}

SurfaceSample ClusterSampler::inStratum(unsigned stratum, unsigned side, double jx, double jy) const {
    return at((stratum + jx) / (side * side), jy).point;
}

ClusterPoints makeClusterPoints(const hierarchy::Hierarchy& hierarchy, NodeId cluster) {
    const ClusterSampler sampler(hierarchy, cluster);
    const std::uint32_t begin = hierarchy.firstPatchBelow(cluster);
    const std::size_t count = hierarchy.patchesBelow(cluster).size();
    const double all = hierarchy.sampledAreaBefore(begin + count) - hierarchy.sampledAreaBefore(begin);
    base::RandomStream random(base::combine(hierarchy.key(cluster), 0xc1));
    ClusterPoints points;
    for (unsigned k = 0; k < kClusterPoints; ++k) {
        const double across = random.next();
        const ClusterSampler::Place at = sampler.at((k + random.next()) / kClusterPoints, across);
        const unsigned block = k / base::kLanes;
        const int lane = static_cast<int>(k % base::kLanes);
        const auto set = [&](base::Lanes3& v, const Vec3d& p) {
            v.x.set(lane, p.x);
            v.y.set(lane, p.y);
            v.z.set(lane, p.z);
        };
        set(points.position[block], at.point.position);
        set(points.normal[block], at.point.normal);
        points.area[block].set(lane, at.point.measure * all / kClusterPoints);
        points.patch[k] = at.patch;
    }
    return points;
}

}  // namespace fluxwalk::transport
