#pragma once

#include <cstdint>
#include <vector>

#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::hierarchy {

/// The tree before its nodes exist: patches under clusters, luminaires and sources in subtrees of their own.
struct Blueprint {
    struct Node {
        NodeKind kind = NodeKind::cluster;
        bool back = false;
        std::uint32_t item = 0;  ///< shaft item of an element, index of a light
        NodeId parent = NodeId::none;
        NodeId firstChild = NodeId::none;
    };
    std::vector<Node> nodes;
};

/// Clusters by `builder` over the patches of the reached sides in `patches`, breadth-first. Empty where
/// nothing is reached and no source shines.
Blueprint drawBlueprint(const scene::Scene& scene, const ReachedSides& reached,
                        const rays::PatchTree& patches, rays::TreeBuilder builder,
                        const base::Executor& executor);

}  // namespace fluxwalk::hierarchy
