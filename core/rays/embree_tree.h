#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/rays/spatial_tree.h"

namespace fluxwalk::rays {

/// Tree by rtcBuildBVH in medium quality: surface area heuristic over binned boxes. `boxes` must be finite
/// and not empty. Where Embree would go deeper than SpatialTree::kMaxDepth, the binned builder takes over.
SpatialTree buildEmbreeTree(std::span<const base::Box> boxes, const base::Executor& executor);

}  // namespace fluxwalk::rays
