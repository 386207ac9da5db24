#include "core/hierarchy/hierarchy.h"

#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/surface/sphere.h"
#include "tests/support/built.h"
#include "tests/support/random_scenes.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3d;
using hierarchy::ElementName;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using hierarchy::Shape;
using test::Built;

// Rooms, an open scene with spheres, all kinds of lights and a sky.
std::vector<scene::Scene> sampleScenes() {
    std::vector<scene::Scene> scenes;
    scenes.push_back(scene::buildCornellBox(base::Rgb(100.0f)));
    scenes.push_back(scene::buildTwoRooms());
    scenes.push_back(scene::buildFurnace(0.5f, true));
    scene::Scene random = test::randomScene(3, 4, 8, 5);
    random.lights.resize(3);
    random.lights[1].kind = scene::LightKind::spot;
    random.lights[2].kind = scene::LightKind::directional;
    random.sky = base::Rgb(500.0f);
    const std::uint32_t dull = scene::addMaterial(random, "dull", base::Rgb(0.3f));
    random.objects[1].material = dull;
    scenes.push_back(std::move(random));
    return scenes;
}

// All nodes below and with `id`, each visited once from its parent.
void collect(const Hierarchy& tree, NodeId id, std::vector<NodeId>& out) {
    out.push_back(id);
    for (unsigned c = 0; !tree.isLeaf(id) && c < tree.childCount(id); ++c) {
        EXPECT_EQ(tree.parent(tree.child(id, c)), id);
        EXPECT_EQ(base::index(tree.child(id, c)), base::index(tree.child(id, 0)) + c) << "one block";
        collect(tree, tree.child(id, c), out);
    }
}

TEST(Hierarchy, everyNodeHangsOnceBelowTheRoot) {
    for (scene::Scene& scene : sampleScenes()) {
        Built built(std::move(scene));
        built.split(1);
        std::vector<NodeId> found;
        ASSERT_EQ(built.tree.parent(built.tree.root()), NodeId::none);
        collect(built.tree, built.tree.root(), found);
        EXPECT_EQ(found.size(), built.tree.nodeCount());
        EXPECT_EQ(std::set<NodeId>(found.begin(), found.end()).size(), found.size());
        std::size_t leaves = 0;
        std::size_t sources = 0;
        for (const NodeId id : found) {
            leaves += built.tree.kind(id) == NodeKind::element && built.tree.isLeaf(id) ? 1u : 0u;
            sources +=
                built.tree.kind(id) == NodeKind::light || built.tree.kind(id) == NodeKind::sky ? 1u : 0u;
        }
        EXPECT_EQ(leaves, built.tree.leafCount());
        EXPECT_EQ(sources, built.tree.sources().size());
    }
}

TEST(Hierarchy, everyReachedSideOfAPatchIsOnePatchNode) {
    for (scene::Scene& scene : sampleScenes()) {
        const Built built(std::move(scene));
        const Hierarchy& tree = built.tree;
        std::size_t expected = 0;
        for (std::uint32_t o = 0; o < built.scene.objects.size(); ++o) {
            for (std::uint32_t p = 0; p < built.scene.objects[o].surface->patchCount(); ++p) {
                for (const bool back : {false, true}) {
                    const NodeId id = tree.patchNode(o, p, back);
                    ASSERT_EQ(id != NodeId::none, tree.reached().isReached(o, p, back));
                    if (id == NodeId::none) {
                        continue;
                    }
                    ++expected;
                    const ElementName name = tree.name(id);
                    EXPECT_EQ(std::tuple(name.object, name.patch, name.back), std::tuple(o, p, back));
                    EXPECT_EQ(name.path, surface::kRootPath);
                }
            }
        }
        EXPECT_EQ(tree.patches().size(), expected);
        const std::set<NodeId> once(tree.patches().begin(), tree.patches().end());
        EXPECT_EQ(once.size(), expected);
        EXPECT_EQ(tree.shaftTree().nodes().size(), 2 * tree.shaftItems().size() - 1) << "all block";
    }
}

TEST(Hierarchy, clustersHoldTheirChildren) {
    for (scene::Scene& scene : sampleScenes()) {
        const Built built(std::move(scene));
        const Hierarchy& tree = built.tree;
        for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
            const NodeId id{n};
            if (tree.kind(id) != NodeKind::cluster) {
                continue;
            }
            const Shape& shape = tree.shape(id);
            float area = 0.0f;
            for (unsigned c = 0; c < 2; ++c) {
                const Shape& child = tree.shape(tree.child(id, c));
                area += child.area;
                if (child.area == 0.0f) {
                    continue;
                }
                // Its sphere holds the children's spheres, or the box about both.
                const hierarchy::Extent& box = tree.extent(id);
                const float across = 0.5f * glm::length(box.upper - box.lower);
                EXPECT_LE(std::min(glm::distance(shape.center, child.center) + child.radius, across),
                          shape.radius * (1.0f + 1e-5f) + 1e-6f);
                const hierarchy::Extent& inner = tree.extent(tree.child(id, c));
                EXPECT_EQ(glm::min(box.lower, inner.lower), box.lower);
                EXPECT_EQ(glm::max(box.upper, inner.upper), box.upper);
                const double between = base::NormalCone::angleBetween(Vec3d(shape.axis), Vec3d(child.axis));
                EXPECT_TRUE(static_cast<double>(shape.halfAngle) > 3.1415 ||
                            between + static_cast<double>(child.halfAngle) <=
                                static_cast<double>(shape.halfAngle) + 1e-5)
                    << between << " and " << child.halfAngle << " in " << shape.halfAngle;
            }
            EXPECT_NEAR(shape.area, area, 1e-5f * area);
        }
    }
}

TEST(Hierarchy, elementsAreBoundedAndMeasuredByTheirSurface) {
    for (scene::Scene& scene : sampleScenes()) {
        Built built(std::move(scene));
        built.split(2);
        const Hierarchy& tree = built.tree;
        base::RandomStream random(5);
        for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
            const NodeId id{n};
            if (tree.kind(id) != NodeKind::element) {
                continue;
            }
            const Shape& shape = tree.shape(id);
            const ElementName name = tree.name(id);
            const surface::Surface& surface = tree.surfaceOf(id);
            const surface::Region region = tree.region(id);
            // Ellipsoids: what the quadrature of a whole octant misses is spread over its elements.
            EXPECT_NEAR(static_cast<double>(shape.area), surface.area(name.patch, region),
                        (shape.isPlanar ? 2e-6 : 1e-3) * static_cast<double>(shape.area));
            for (int i = 0; i < 4; ++i) {
                const surface::SurfacePoint p =
                    surface.evaluate(name.patch, surface::mapToRegion(region, random.next2()).uv);
                EXPECT_LE(glm::distance(p.position, Vec3d(shape.center)),
                          static_cast<double>(shape.radius) * (1.0 + 1e-5) + 1e-6);
                const Vec3d normal = name.back ? -p.normal : p.normal;
                EXPECT_LE(base::NormalCone::angleBetween(normal, Vec3d(shape.axis)),
                          static_cast<double>(shape.halfAngle) + 1e-5);
            }
        }
    }
}

TEST(Hierarchy, luminairesFormASubtreeOfTheirOwn) {
    const Built built(scene::buildTwoRooms());
    const Hierarchy& tree = built.tree;
    const auto isLuminaire = [&](NodeId id) {
        return built.scene.materials[built.scene.objects[tree.name(id).object].material].isEmissive();
    };
    std::size_t luminaires = 0;
    for (const NodeId id : tree.patches()) {
        luminaires += isLuminaire(id) ? 1u : 0u;
    }
    ASSERT_GT(luminaires, 0u);
    bool found = false;
    for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
        const std::vector<NodeId> leaves = built.leavesOf(NodeId{n});
        found =
            found || (leaves.size() == luminaires && std::all_of(leaves.begin(), leaves.end(), isLuminaire));
    }
    EXPECT_TRUE(found);
}

TEST(Hierarchy, sourcesCarryTheirLight) {
    scene::Scene scene = sampleScenes().back();
    scene.lights[1].intensity = base::Rgb(1.0f, 2.0f, 3.0f);
    const Built built(std::move(scene));
    ASSERT_EQ(built.tree.sources().size(), 4u);
    std::size_t lights = 0;
    for (const NodeId id : built.tree.sources()) {
        if (built.tree.kind(id) == NodeKind::sky) {
            EXPECT_EQ(built.tree.light(id).radiosity, base::Rgb(500.0f));
        } else {
            ++lights;
            EXPECT_EQ(built.tree.light(id).radiosity,
                      built.scene.lights[built.tree.lightIndex(id)].intensity);
        }
        EXPECT_FALSE(built.tree.canSplit(id, 0.0));
    }
    EXPECT_EQ(lights, 3u);
}

TEST(Hierarchy, keysAreUniqueAndTheSameInEveryRun) {
    Built first(sampleScenes().back(), 7);
    Built second(sampleScenes().back(), 7);
    first.split(2);
    // Another history: one half of the leaves first.
    second.split(1, [&](NodeId id) { return base::index(id) % 2 == 0; });
    second.split(1, [&](NodeId id) { return second.tree.name(id).path == surface::kRootPath; });
    second.split(1);
    const auto keysOf = [](const Built& built) {
        std::map<std::uint64_t, std::tuple<std::uint32_t, std::uint32_t, bool, surface::Path>> keys;
        for (std::uint32_t n = 0; n < built.tree.nodeCount(); ++n) {
            const ElementName name = built.tree.name(NodeId{n});
            const bool isNew =
                keys.insert({built.tree.key(NodeId{n}), {name.object, name.patch, name.back, name.path}})
                    .second;
            EXPECT_TRUE(isNew) << "node " << n << " shares its key";
        }
        return keys;
    };
    EXPECT_EQ(keysOf(first), keysOf(second));
    const Built other(sampleScenes().back(), 8);
    EXPECT_NE(first.tree.key(first.tree.patches()[0]), other.tree.key(other.tree.patches()[0]));
}

TEST(Hierarchy, isTheSameForAnyNumberOfThreads) {
    for (const bool rooms : {true, false}) {
        const auto build = [rooms] { return rooms ? scene::buildTwoRooms() : sampleScenes().back(); };
        Built one(build(), 1, 1);
        one.split(2);
        for (const unsigned threads : {2u, 8u}) {
            Built many(build(), 1, threads);
            many.split(2);
            ASSERT_EQ(many.tree.nodeCount(), one.tree.nodeCount());
            for (std::uint32_t n = 0; n < one.tree.nodeCount(); ++n) {
                const NodeId id{n};
                ASSERT_EQ(one.tree.kind(id), many.tree.kind(id));
                ASSERT_EQ(one.tree.key(id), many.tree.key(id));
                const Shape& a = one.tree.shape(id);
                const Shape& b = many.tree.shape(id);
                ASSERT_EQ(a.center, b.center);
                ASSERT_EQ(a.corners, b.corners);
                ASSERT_EQ(a.area, b.area);
                ASSERT_EQ(a.exposed, b.exposed);
                ASSERT_EQ(a.exposedCells, b.exposedCells);
                ASSERT_EQ(a.axis, b.axis);
            }
        }
    }
}

TEST(Hierarchy, nothingAndOnePatch) {
    const Built nothing{scene::Scene{}};
    EXPECT_EQ(nothing.tree.root(), NodeId::none);
    EXPECT_EQ(nothing.tree.nodeCount(), 0u);
    scene::Scene scene;
    scene::addMaterial(scene, "lamp", base::Rgb(0.5f), base::Rgb(1.0f));
    scene::addPolygons(scene, "lamp", 0, scene::boxFaces(Vec3d(0.0), {2, 0, 3}, scene::kTop));
    const Built one(std::move(scene));
    ASSERT_EQ(one.tree.nodeCount(), 1u);
    EXPECT_EQ(one.tree.kind(one.tree.root()), NodeKind::element);
    EXPECT_FLOAT_EQ(one.tree.shape(one.tree.root()).area, 6.0f);
    EXPECT_NEAR(one.tree.totalArea(), 6.0, 1e-6);
}

}  // namespace
}  // namespace fluxwalk
