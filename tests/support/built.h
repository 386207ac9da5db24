#pragma once

#include <functional>

#include "core/hierarchy/hierarchy.h"
#include "core/scene/scene.h"

namespace fluxwalk::test {

/// A scene with what a hierarchy needs around it. Not movable: the parts point at each other.
struct Built {
    explicit Built(scene::Scene given, std::uint64_t seed = 1, unsigned threads = 1)
        : scene(std::move(given)),
          executor(threads),
          rays(scene, executor),
          tree(scene, rays, executor, seed) {}
    Built(const Built&) = delete;
    Built& operator=(const Built&) = delete;

    scene::Scene scene;
    base::Executor executor;
    rays::RayScene rays;
    hierarchy::Hierarchy tree;

    /// Quarters all leaves that `wants` names, `times` times over.
    void split(unsigned times, const std::function<bool(base::NodeId)>& wants = {}) {
        for (unsigned i = 0; i < times; ++i) {
            std::vector<base::NodeId> leaves;
            for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
                const base::NodeId id{n};
                if (tree.kind(id) == hierarchy::NodeKind::element && tree.isLeaf(id) &&
                    (!wants || wants(id))) {
                    leaves.push_back(id);
                }
            }
            tree.split(leaves, executor);
        }
    }

    /// Leaves below a node.
    std::vector<base::NodeId> leavesOf(base::NodeId id) const {
        if (tree.isLeaf(id)) {
            return {id};
        }
        std::vector<base::NodeId> all;
        for (unsigned c = 0; c < tree.childCount(id); ++c) {
            const std::vector<base::NodeId> below = leavesOf(tree.child(id, c));
            all.insert(all.end(), below.begin(), below.end());
        }
        return all;
    }
};

}  // namespace fluxwalk::test
