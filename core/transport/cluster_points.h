#pragma once

#include "core/base/simd.h"
#include "core/transport/element_sampler.h"

/// Clusters as transport sees them: points of the surfaces that they contain.
namespace fluxwalk::transport {

/// Points of a cluster's exposed surfaces, by area.
class ClusterSampler {
  public:
    ClusterSampler(const hierarchy::Hierarchy& hierarchy, NodeId cluster);

    /// Point in one of side x side strata of the surfaces in the order of the tree, at (jx, jy) in [0, 1)^2
    /// within it; `measure` is relative to its mean, `local` is 0.
    SurfaceSample inStratum(unsigned stratum, unsigned side, double jx, double jy) const;

    /// Patch, as an index into Hierarchy::patches(), and point at part `place` in [0, 1) of the area in that
    /// order and `across` it.
    struct Place {
        std::uint32_t patch = 0;
        SurfaceSample point;
    };
    Place at(double place, double across) const;

  private:
    const hierarchy::Hierarchy& hierarchy_;
    std::uint32_t begin_ = 0;
    std::uint32_t end_ = 0;
    double before_ = 0.0;
    double area_ = 0.0;
};

/// Points that stand for a cluster in kernels, each for an equal part of its exposed area.
inline constexpr unsigned kClusterPoints = 32;
inline constexpr unsigned kClusterBlocks = kClusterPoints / base::kLanes;
struct alignas(base::kLanesAlignment) ClusterPoints {
    std::array<base::Lanes3, kClusterBlocks> position;
    std::array<base::Lanes3, kClusterBlocks> normal;
    /// Area of each point in m2.
    std::array<base::Lanes, kClusterBlocks> area;
    /// Index into Hierarchy::patches().
    std::array<std::uint32_t, kClusterPoints> patch{};
};
ClusterPoints makeClusterPoints(const hierarchy::Hierarchy& hierarchy, NodeId cluster);

}  // namespace fluxwalk::transport
