#include "core/scene/builders.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/hierarchy/hierarchy.h"
#include "tests/support/random_scenes.h"

// What holds for clusters by any builder.

namespace fluxwalk {
namespace {

using base::NodeId;
using hierarchy::ElementName;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using rays::RayEngine;
using rays::TreeBuilder;

constexpr std::array kBuilders = {TreeBuilder::sah, TreeBuilder::hybrid, TreeBuilder::embree};

using Name = std::tuple<std::uint32_t, std::uint32_t, bool>;

Name nameOf(const Hierarchy& tree, NodeId id) {
    const ElementName name = tree.name(id);
    return {name.object, name.patch, name.back};
}

std::vector<Name> patchNames(const Hierarchy& tree) {
    std::vector<Name> names;
    for (const NodeId id : tree.patches()) {
        names.push_back(nameOf(tree, id));
    }
    return names;
}

bool isLuminaire(const Hierarchy& tree, NodeId id) {
    const scene::Scene& scene = tree.scene();
    return scene.materials[scene.objects[tree.name(id).object].material].isEmissive();
}

// Patches below a node: {luminaires, others}. `mixed` counts the nodes below which both lie.
std::array<std::size_t, 2> countPatches(const Hierarchy& tree, NodeId id, std::size_t& mixed) {
    if (tree.kind(id) == NodeKind::element) {
        return isLuminaire(tree, id) ? std::array<std::size_t, 2>{1, 0} : std::array<std::size_t, 2>{0, 1};
    }
    std::array<std::size_t, 2> counts{};
    for (unsigned c = 0; !tree.isLeaf(id) && c < tree.childCount(id); ++c) {
        const auto below = countPatches(tree, tree.child(id, c), mixed);
        counts[0] += below[0];
        counts[1] += below[1];
    }
    mixed += counts[0] > 0 && counts[1] > 0 ? 1u : 0u;
    return counts;
}

std::vector<scene::Scene> sampleScenes() {
    std::vector<scene::Scene> scenes;
    scenes.push_back(scene::buildGallery());
    scenes.push_back(scene::buildTwoRooms());
    scene::Scene cloud = test::randomScene(31, 3, 500, 6, 0.1);
    cloud.objects[1].material = scene::addMaterial(cloud, "dull", base::Rgb(0.3f));
    scenes.push_back(std::move(cloud));
    return scenes;
}

TEST(ClusterBuilders, giveTheSamePatchesAndKeepLuminairesApart) {
    for (const scene::Scene& scene : sampleScenes()) {
        const base::Executor executor(2);
        const rays::RayScene rays(scene, executor);
        std::vector<Name> expected;
        for (const TreeBuilder builder : kBuilders) {
            const Hierarchy tree(scene, rays, executor, 1, builder);
            std::vector<Name> names = patchNames(tree);
            std::sort(names.begin(), names.end());
            EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
            if (expected.empty()) {
                expected = names;
            }
            EXPECT_EQ(names, expected) << static_cast<int>(builder);
            std::size_t mixed = 0;
            const auto counts = countPatches(tree, tree.root(), mixed);
            EXPECT_EQ(counts[0] + counts[1], names.size());
            EXPECT_GT(counts[0], 0u);
            EXPECT_GT(counts[1], 0u);
            // Only the root, and those on the way to where luminaires and others part: one for each source.
            EXPECT_EQ(mixed, 1 + tree.sources().size()) << static_cast<int>(builder);
        }
    }
}

TEST(ClusterBuilders, giveTheSameTreeForAnyNumberOfThreads) {
    for (const scene::Scene& scene : sampleScenes()) {
        for (const TreeBuilder builder : kBuilders) {
            std::vector<std::vector<Name>> orders;
            for (const unsigned threads : {1u, 2u, 8u}) {
                const base::Executor executor(threads);
                const rays::RayScene rays(scene, executor, RayEngine::clusters, builder);
                const Hierarchy tree(scene, rays, executor, 1, builder);
                EXPECT_EQ(&tree.shaftTree(), &rays.patchTree()->tree) << "one tree for rays and shafts";
                orders.push_back(patchNames(tree));
            }
            EXPECT_EQ(orders[0], orders[1]);
            EXPECT_EQ(orders[0], orders[2]);
        }
    }
}

TEST(ClusterBuilders, takeThousandsOfCoincidentPolygons) {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(0.5f), base::Rgb(1.0f));
    const scene::Quads quads(2000, {base::Vec3d(0.0), base::Vec3d(1.0, 0.0, 0.0), base::Vec3d(1.0, 0.0, 1.0),
                                    base::Vec3d(0.0, 0.0, 1.0)});
    scene::addPolygons(scene, "quads", grey, quads);
    const base::Executor executor(2);
    for (const TreeBuilder builder : kBuilders) {
        const rays::RayScene rays(scene, executor, RayEngine::clusters, builder);
        const Hierarchy tree(scene, rays, executor, 1, builder);
        EXPECT_EQ(tree.shaftItems().size(), 4000u) << "triangles: of equal edges none is shared by just two";
        for (const NodeId id : tree.patches()) {
            std::size_t depth = 0;
            for (NodeId at = id; at != NodeId::none; at = tree.parent(at)) {
                ++depth;
            }
            EXPECT_LE(depth, 14u) << "4096 leaves, two sides each";
        }
    }
}

}  // namespace
}  // namespace fluxwalk
