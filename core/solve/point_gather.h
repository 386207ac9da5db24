#pragma once

#include "core/solve/state.h"

namespace fluxwalk::solve {

/// A point of a side that light reaches.
struct GatherPoint {
    NodeId leaf = NodeId::none;
    Vec3d position{};
    Vec3d normal{};  ///< towards the side that receives
};

/// Light that one source, a leaf, patch or light without area, brings to a point, lux.
struct Contribution {
    NodeId source = NodeId::none;
    Vec3d irradiance{0.0};
};

/// What one source, a leaf, a cluster or a light without area, was found to bring to a point, and how surely.
/// Factors are dimensionless: irradiance by the source's radiosity.
struct GatheredSource {
    NodeId source = NodeId::none;
    Vec3d irradiance{0.0};  ///< lux
    /// Form factor without occlusion (clusters: from their sampled points; 0 for lights without area), and
    /// the part of it that arrives.
    double factor = 0.0;
    double transfer = 0.0;
    /// Variance of `transfer` that its shadow rays leave, and for clusters their points too.
    double variance = 0.0;
    /// How far the kernel varies over the source as seen from the point, relative: standard deviation by
    /// mean.
    double spread = 0.0;
    /// Whether the factor is a quadrature, not exact (curved sources, clusters).
    bool isSampled = false;
    bool isOpen = false;  ///< certainly unoccluded
};

/// Irradiance at a point in lux, each channel: the links of its leaf and of all ancestors name the sources,
/// each is integrated again from the point with its exact form factor and shadow rays of the point's own
/// (Schaefer, section 1, final gathering; ALGORITHMS 1.14). Sources whose radiosity varies are opened where
/// that matters.
/// `contributions`, if given, gets the parts of the sum; `sources`, if given, how sure they are.
Rgb gatherAtPoint(const Problem& problem, const GatherPoint& point,
                  std::vector<Contribution>* contributions = nullptr,
                  std::vector<GatheredSource>* sources = nullptr);

/// The same for a point in free space: sources are found from the root, by the same criterion.
Rgb gatherInSpace(const Problem& problem, const Vec3d& position, const Vec3d& normal,
                  std::vector<GatheredSource>* sources = nullptr);

/// The leaf of a patch's side that holds the parameter uv; nothing where light does not reach that side.
std::optional<NodeId> findLeaf(const Problem& problem, std::uint32_t object, std::uint32_t patch, bool back,
                               const base::Vec2d& uv);

}  // namespace fluxwalk::solve
