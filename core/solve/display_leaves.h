#pragma once

#include <span>
#include <vector>

#include "core/display/leaf.h"
#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::solve {

/// What the display shows of a leaf element.
display::Leaf displayLeaf(const hierarchy::Hierarchy& h, base::NodeId leaf);

/// Calls visit(leaf) for the leaves of patches, depth-first.
template <class Visit>
void forLeaves(const hierarchy::Hierarchy& h, std::span<const base::NodeId> patches, const Visit& visit) {
    std::vector<base::NodeId> stack;
    for (const base::NodeId patch : patches) {
        stack.push_back(patch);
        while (!stack.empty()) {
            const base::NodeId id = stack.back();
            stack.pop_back();
            if (h.isLeaf(id)) {
                visit(id);
                continue;
            }
            for (unsigned c = 4; c-- > 0;) {
                stack.push_back(h.child(id, c));
            }
        }
    }
}

}  // namespace fluxwalk::solve
