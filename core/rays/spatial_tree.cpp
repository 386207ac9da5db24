#include "core/rays/spatial_tree.h"

#include <cmath>

namespace fluxwalk::rays {

SpatialTree::SpatialTree(std::vector<Node> nodes, std::vector<TreeGrid> grids,
                         std::span<const base::Box> boxes)
    : nodes_(std::move(nodes)), grids_(std::move(grids)) {
    // Children follow their parents: from the back, they are done first.
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.isLeaf()) {
            const base::Box& box = boxes[node.item];
            for (int k = 0; k < 3; ++k) {
                node.lower[k] = std::nextafter(static_cast<float>(box.lower[k]), -INFINITY);
                node.upper[k] = std::nextafter(static_cast<float>(box.upper[k]), INFINITY);
            }
        } else {
            node.lower = glm::min(nodes_[i + 1].lower, nodes_[node.right].lower);
            node.upper = glm::max(nodes_[i + 1].upper, nodes_[node.right].upper);
        }
    }
}

SpatialTree SpatialTree::join(const SpatialTree& first, const SpatialTree& second, std::uint32_t itemOffset) {
    SpatialTree joined;
    const bool both = !first.isEmpty() && !second.isEmpty();
    const std::uint32_t head = both ? 1 : 0;
    if (both) {
        Node root;
        root.lower = glm::min(first.nodes_[0].lower, second.nodes_[0].lower);
        root.upper = glm::max(first.nodes_[0].upper, second.nodes_[0].upper);
        root.right = head + static_cast<std::uint32_t>(first.nodes_.size());
        joined.nodes_.push_back(root);
    }
    const auto append = [&joined](const SpatialTree& tree, std::uint32_t itemShift) {
        const auto base = static_cast<std::uint32_t>(joined.nodes_.size());
        for (Node node : tree.nodes_) {
            node.right = node.right == kNone ? kNone : node.right + base;
            node.item = node.item == kNone ? kNone : node.item + itemShift;
            joined.nodes_.push_back(node);
        }
        for (TreeGrid grid : tree.grids_) {
            grid.node += base;
            joined.grids_.push_back(grid);
        }
    };
    append(first, 0);
    append(second, itemOffset);
    return joined;
}

}  // namespace fluxwalk::rays
