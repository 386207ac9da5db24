#include "core/rays/tree_builder.h"

#include "core/base/check.h"
#include "core/rays/binned_tree.h"
#include "core/rays/embree_tree.h"

namespace fluxwalk::rays {

SpatialTree buildTree(TreeBuilder builder, const TreeItems& items, const base::Executor& executor) {
    if (items.boxes.empty()) {
        return {};
    }
    FLUXWALK_CHECK(items.normals.empty() || items.normals.size() == items.boxes.size());
    FLUXWALK_CHECK_EQ(items.normals.size(), items.areas.size());
    switch (builder) {
        case TreeBuilder::sah:
            return buildBinnedTree(items,
                                   {.orientationWeight = items.normals.empty() ? 0.0f : kOrientationWeight,
                                    .splitsLongFirst = true},
                                   executor);
        case TreeBuilder::hybrid:
            return buildBinnedTree(items, {.usesGrids = true}, executor);
        case TreeBuilder::embree:
            break;
    }
    return buildEmbreeTree(items.boxes, executor);
}

}  // namespace fluxwalk::rays
