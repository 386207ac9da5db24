#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/bounds.h"
#include "core/base/parallel.h"

namespace fluxwalk::rays {

/// Binary tree over boxes in depth-first order: node i's left child is i + 1. Clusters copy its topology,
/// shafts descend it.
class SpatialTree {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Node {
        base::Vec3 lower{};
        std::uint32_t right = kNone;  ///< right child of an inner node, kNone for a leaf
        base::Vec3 upper{};
        std::uint32_t item = kNone;  ///< index of the leaf's box, kNone for inner nodes

        bool isLeaf() const { return right == kNone; }
    };

    SpatialTree() = default;
    /// One leaf for each box; surface area heuristic (rtcBuildBVH), the same tree for any number of threads.
    /// Boxes must be finite.
    SpatialTree(std::span<const base::Box> boxes, const base::Executor& executor);

    /// Joins two trees under a new root; items of `second` are shifted by `itemOffset`.
    static SpatialTree join(const SpatialTree& first, const SpatialTree& second, std::uint32_t itemOffset);

    bool isEmpty() const { return nodes_.empty(); }
    std::span<const Node> nodes() const { return nodes_; }

  private:
    std::vector<Node> nodes_;
};

}  // namespace fluxwalk::rays
