#pragma once

#include "core/base/parallel.h"
#include "core/rays/tree_builder.h"

namespace fluxwalk::rays {

/// Weight lambda of the normals' spread for TreeBuilder::sah. Measured (tests/bench/builder_bench.cpp): 1
/// lowers the spread of normals in a cluster by a quarter to a third in rooms for 5 % more surface; more buys
/// little.
inline constexpr float kOrientationWeight = 1.0f;

/// How a binned tree weighs its splits.
struct BinnedTreeOptions {
    /// lambda in the cost of a half: surface of its box * number of items * (1 + lambda * solid angle / 4
    /// pi). The solid angle is that of the cap with the same mean normal, as means of normals can be added
    /// and one odd item does not spoil them.
    float orientationWeight = 0.0f;
    /// A box that is much longer than wide is cut across its length wherever its items allow it: long thin
    /// clusters see each other under too many angles to be linked.
    bool splitsLongFirst = false;
    /// Evenly filled regions become regular grids.
    bool usesGrids = false;
};

/// Top-down surface area heuristic in bins (exact sweeps for few items), items in place. Level by level while
/// nodes are large, then one task for each subtree; node indices follow from the numbers of items. O(n log
/// n). `items` must be finite and not empty.
SpatialTree buildBinnedTree(const TreeItems& items, const BinnedTreeOptions& options,
                            const base::Executor& executor);

}  // namespace fluxwalk::rays
