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

/// Irradiance at a point in lux, each channel: the links of its leaf and of all ancestors name the sources,
/// each is integrated again from the point with its exact form factor and shadow rays of the point's own
/// (Schaefer, section 1, final gathering; ALGORITHMS 1.14). Sources whose radiosity varies are opened where
/// that matters.
/// `contributions`, if given, gets the parts of the sum.
Rgb gatherAtPoint(const Problem& problem, const GatherPoint& point,
                  std::vector<Contribution>* contributions = nullptr);

/// The same for a point in free space: sources are found from the root, by the same criterion.
Rgb gatherInSpace(const Problem& problem, const Vec3d& position, const Vec3d& normal);

/// The leaf of a patch's side that holds the parameter uv; nothing where light does not reach that side.
std::optional<NodeId> findLeaf(const Problem& problem, std::uint32_t object, std::uint32_t patch, bool back,
                               const base::Vec2d& uv);

}  // namespace fluxwalk::solve
