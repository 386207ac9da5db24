#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/bounds.h"

namespace fluxwalk::rays {

/// A region of the tree that is evenly filled: rays may walk `cells` equal cells of the node's box instead of
/// descending below it.
struct TreeGrid {
    std::uint32_t node = 0;
    std::array<std::uint32_t, 3> cells{1, 1, 1};
};

/// Binary tree over boxes in depth-first order: node i's left child is i + 1. Clusters copy its topology,
/// shafts and rays descend it. Made by buildTree() (tree_builder.h).
class SpatialTree {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    /// Builders make no tree deeper than this (nodes from the root to a leaf, both counted).
    static constexpr std::size_t kMaxDepth = 64;

    struct Node {
        base::Vec3 lower{};
        std::uint32_t right = kNone;  ///< right child of an inner node, kNone for a leaf
        base::Vec3 upper{};
        std::uint32_t item = kNone;  ///< index of the leaf's box, kNone for inner nodes

        bool isLeaf() const { return right == kNone; }
    };

    SpatialTree() = default;
    /// Takes the topology from `nodes` (`right` and `item` set, depth-first); leaves get the boxes of their
    /// items rounded outwards to float, inner nodes what holds their children. Grids in order of their nodes.
    SpatialTree(std::vector<Node> nodes, std::vector<TreeGrid> grids, std::span<const base::Box> boxes);

    /// Joins two trees under a new root; items of `second` are shifted by `itemOffset`.
    static SpatialTree join(const SpatialTree& first, const SpatialTree& second, std::uint32_t itemOffset);

    bool isEmpty() const { return nodes_.empty(); }
    std::span<const Node> nodes() const { return nodes_; }
    /// Disjoint: no grid's node lies below another's.
    std::span<const TreeGrid> grids() const { return grids_; }

  private:
    std::vector<Node> nodes_;
    std::vector<TreeGrid> grids_;
};

}  // namespace fluxwalk::rays
