#include "core/hierarchy/blueprint.h"

#include <array>

#include "core/base/photometry.h"
#include "core/surface/region.h"

namespace fluxwalk::hierarchy {

namespace {

bool isLuminaire(const scene::Scene& scene, std::uint32_t object) {
    return scene.materials[scene.objects[object].material].isEmissive();
}

/// Loose binary tree that a blueprint is laid out from.
struct Sketch {
    struct Node {
        Blueprint::Node what;
        std::array<std::uint32_t, 2> children{};
    };
    std::vector<Node> nodes;

    std::uint32_t addLeaf(NodeKind kind, std::uint32_t item, bool back) {
        nodes.push_back({{kind, back, item, NodeId::none, NodeId::none}, {}});
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }
    std::uint32_t addPair(std::uint32_t a, std::uint32_t b) {
        nodes.push_back({{}, {a, b}});
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }
    std::uint32_t addChain(const std::vector<std::uint32_t>& parts) {
        std::uint32_t top = parts.front();
        for (std::size_t i = 1; i < parts.size(); ++i) {
            top = addPair(top, parts[i]);
        }
        return top;
    }

    // Copies a spatial tree's topology; a patch reached on both sides becomes a pair.
    std::uint32_t addTree(const rays::SpatialTree& tree, std::span<const std::uint32_t> items,
                          std::span<const std::array<bool, 2>> sides) {
        std::vector<std::uint32_t> made(tree.nodes().size());
        for (std::size_t i = tree.nodes().size(); i-- > 0;) {
            const rays::SpatialTree::Node& node = tree.nodes()[i];
            if (!node.isLeaf()) {
                made[i] = addPair(made[i + 1], made[node.right]);
                continue;
            }
            std::vector<std::uint32_t> parts;
            for (const bool back : {false, true}) {
                if (sides[node.item][back ? 1 : 0]) {
                    parts.push_back(addLeaf(NodeKind::element, items[node.item], back));
                }
            }
            made[i] = addChain(parts);
        }
        return made.front();
    }

    Blueprint layOut(std::uint32_t root) const {
        Blueprint plan;
        std::vector<std::uint32_t> from{root};
        plan.nodes.push_back(nodes[root].what);
        // Breadth first: the children of one node are two neighbours.
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (plan.nodes[i].kind != NodeKind::cluster) {
                continue;
            }
            plan.nodes[i].firstChild = NodeId{static_cast<std::uint32_t>(from.size())};
            for (const std::uint32_t child : nodes[from[i]].children) {
                from.push_back(child);
                plan.nodes.push_back(nodes[child].what);
                plan.nodes.back().parent = NodeId{static_cast<std::uint32_t>(i)};
            }
        }
        return plan;
    }
};

/// What a cluster tree is built over, one entry for each patch that light reaches.
struct ReachedPatches {
    std::vector<base::Box> boxes;
    std::vector<base::NormalCone> normals;
    std::vector<double> areas;
    std::vector<std::uint32_t> items;  ///< shaft items
    std::vector<std::array<bool, 2>> sides;

    ReachedPatches(const scene::Scene& scene, const ReachedSides& sidesOf, const rays::PatchTree& patches,
                   bool luminaires, const base::Executor& executor) {
        for (std::uint32_t item = 0; item < patches.items.size(); ++item) {
            const auto [object, patch] = patches.items[item];
            const std::array<bool, 2> reached{sidesOf.isReached(object, patch, false),
                                              sidesOf.isReached(object, patch, true)};
            if ((reached[0] || reached[1]) && isLuminaire(scene, object) == luminaires) {
                boxes.push_back(patches.boxes[item]);
                items.push_back(item);
                sides.push_back(reached);
            }
        }
        normals.resize(items.size());
        areas.resize(items.size());
        executor.forRange(items.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto [object, patch] = patches.items[items[i]];
                const surface::Surface& surface = *scene.objects[object].surface;
                const surface::Region whole = surface::wholePatch(surface.domain(patch));
                normals[i] = surface.bounds(patch, whole).normals;
                areas[i] = surface.area(patch, whole);
                if (sides[i][0] && sides[i][1]) {
                    normals[i].halfAngle = base::kPi;
                } else if (sides[i][1]) {
                    normals[i].axis = -normals[i].axis;
                }
            }
        });
    }
};

}  // namespace

Blueprint drawBlueprint(const scene::Scene& scene, const ReachedSides& reached,
                        const rays::PatchTree& patches, rays::TreeBuilder builder,
                        const base::Executor& executor) {
    Sketch sketch;
    std::vector<std::uint32_t> parts;
    for (const bool luminaires : {true, false}) {
        const ReachedPatches chosen(scene, reached, patches, luminaires, executor);
        if (!chosen.items.empty()) {
            const rays::SpatialTree tree =
                rays::buildTree(builder, {chosen.boxes, chosen.normals, chosen.areas}, executor);
            parts.push_back(sketch.addTree(tree, chosen.items, chosen.sides));
        }
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        parts.push_back(sketch.addLeaf(NodeKind::light, i, false));
    }
    if (scene.sky != Rgb(0.0f)) {
        parts.push_back(sketch.addLeaf(NodeKind::sky, 0, false));
    }
    return parts.empty() ? Blueprint{} : sketch.layOut(sketch.addChain(parts));
}

}  // namespace fluxwalk::hierarchy
