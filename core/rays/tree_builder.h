#pragma once

#include <cstdint>
#include <span>

#include "core/base/normal_cone.h"
#include "core/base/parallel.h"
#include "core/rays/spatial_tree.h"

/// The ways to build a tree over boxes, for clusters, shafts and rays alike.
namespace fluxwalk::rays {

enum class TreeBuilder : std::uint8_t {
    /// Surface area heuristic in bins, with a term for the spread of normals (binned_tree.h).
    sah,
    /// Number and surface alone, and regular grids where a region is evenly filled (Mueller and Fellner 1999,
    /// Schaefer, section 3).
    hybrid,
    /// Embree's rtcBuildBVH, which sees boxes only.
    embree
};

/// What a tree is built over, index by index.
struct TreeItems {
    /// Must be finite.
    std::span<const base::Box> boxes;
    /// Normals and areas (m2) of what the boxes hold; both empty where orientation shall not count.
    std::span<const base::NormalCone> normals{};
    std::span<const double> areas{};
};

/// One leaf for each box, at most SpatialTree::kMaxDepth deep; the same tree for any number of threads.
SpatialTree buildTree(TreeBuilder builder, const TreeItems& items, const base::Executor& executor);

}  // namespace fluxwalk::rays
