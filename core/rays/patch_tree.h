#pragma once

#include <cstdint>
#include <vector>

#include "core/rays/tree_builder.h"
#include "core/scene/scene.h"

namespace fluxwalk::rays {

/// A patch of an object.
struct PatchRef {
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
};

/// Boxes of all patches of all objects, whether light reaches them or not, and the tree over them: one
/// structure for rays and shafts.
struct PatchTree {
    PatchTree(const scene::Scene& scene, TreeBuilder by, const base::Executor& executor);

    TreeBuilder builder;
    std::vector<PatchRef> items;  ///< in order of objects and patches
    std::vector<base::Box> boxes;
    std::vector<std::uint32_t> firstItem;  ///< of each object
    SpatialTree tree;
};

}  // namespace fluxwalk::rays
