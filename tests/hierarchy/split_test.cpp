#include <bit>
#include <set>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/hierarchy/hierarchy.h"
#include "core/scene/builders.h"
#include "core/surface/sphere.h"
#include "tests/support/built.h"
#include "tests/support/random_scenes.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec3;
using base::Vec3d;
using hierarchy::ElementName;
using hierarchy::NodeKind;
using hierarchy::Shape;
using test::Built;

// One emitting object, lit on both sides if asked for.
scene::Scene sceneOf(std::shared_ptr<const surface::Surface> surface, bool doubleSided = false) {
    scene::Scene scene;
    scene::addMaterial(scene, "glow", base::Rgb(0.5f), base::Rgb(2.0f));
    scene.materials[0].doubleSided = doubleSided;
    scene.objects.push_back({"object", std::move(surface), 0});
    return scene;
}

scene::Scene glowingBox() {
    scene::Scene scene;
    scene::addMaterial(scene, "glow", base::Rgb(0.5f), base::Rgb(2.0f));
    scene::addPolygons(scene, "box", 0, scene::boxFaces({0.1, 0.2, 0.3}, {1.3, 2.3, 1.1}));
    return scene;
}

std::shared_ptr<surface::Sphere> ball(bool inside = false) {
    return std::make_shared<surface::Sphere>(Vec3d(0.3, -0.2, 0.7), 1.3, inside);
}

std::shared_ptr<surface::Sphere> egg() {
    base::Mat4d place(1.0);
    place[0] = {1.1, 0.3, 0.0, 0.0};
    place[1] = {-0.2, 0.7, 0.1, 0.0};
    place[2] = {0.0, 0.2, 1.9, 0.0};
    place[3] = {2.0, 0.0, -1.0, 1.0};
    return std::make_shared<surface::Sphere>(place);
}

std::array<std::uint32_t, 3> bitsOf(const Vec3& p) {
    return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
            std::bit_cast<std::uint32_t>(p.z)};
}

// Distinct corners of all leaves, told apart by their bits.
std::size_t countVertices(const Built& built) {
    std::set<std::array<std::uint32_t, 3>> vertices;
    for (std::uint32_t n = 0; n < built.tree.nodeCount(); ++n) {
        const NodeId id{n};
        if (built.tree.kind(id) == NodeKind::element && built.tree.isLeaf(id)) {
            const Shape& shape = built.tree.shape(id);
            for (std::uint32_t i = 0; i < shape.cornerCount; ++i) {
                vertices.insert(bitsOf(shape.corners[i] + Vec3(0.0f)));
            }
        }
    }
    return vertices.size();
}

template <class Check>
void forSplitElements(const Built& built, const Check& check) {
    for (std::uint32_t n = 0; n < built.tree.nodeCount(); ++n) {
        if (built.tree.kind(NodeId{n}) == NodeKind::element && !built.tree.isLeaf(NodeId{n})) {
            check(NodeId{n});
        }
    }
}

TEST(Split, areasSumToTheParents) {
    std::vector<scene::Scene> scenes;
    scenes.push_back(glowingBox());
    scenes.push_back(sceneOf(ball()));
    scenes.push_back(sceneOf(egg()));
    scenes.push_back(test::randomScene(5, 3, 6, 4));
    for (scene::Scene& scene : scenes) {
        Built built(std::move(scene));
        built.split(4);
        double patchArea = 0.0;
        double leafArea = 0.0;
        for (const NodeId id : built.tree.patches()) {
            patchArea += static_cast<double>(built.tree.shape(id).area);
            for (const NodeId leaf : built.leavesOf(id)) {
                leafArea += static_cast<double>(built.tree.shape(leaf).area);
            }
        }
        EXPECT_NEAR(leafArea, patchArea, 1e-6 * patchArea);
        forSplitElements(built, [&](NodeId id) {
            const double area = static_cast<double>(built.tree.shape(id).area);
            double sum = 0.0;
            for (unsigned c = 0; c < 4; ++c) {
                sum += static_cast<double>(built.tree.shape(built.tree.child(id, c)).area);
            }
            // Two units in the last place of float.
            EXPECT_NEAR(sum, area, 2.4e-7 * area);
        });
    }
}

// Euler: a closed surface of F quads has F + 2 corners, one of F triangles has F / 2 + 2. One more would be a
// corner that neighbours do not share bitwise.
TEST(Split, neighboursShareTheirCornersBitwise) {
    for (unsigned level = 0; level <= 4; ++level) {
        const std::size_t grown = std::size_t{1} << (2 * level);
        Built box(glowingBox());
        box.split(level);
        EXPECT_EQ(countVertices(box), 6 * grown + 2) << level;
        Built sphere(sceneOf(ball()));
        sphere.split(level);
        EXPECT_EQ(countVertices(sphere), 4 * grown + 2) << level;
        Built ellipsoid(sceneOf(egg()));
        ellipsoid.split(level);
        EXPECT_EQ(countVertices(ellipsoid), 4 * grown + 2) << level;
    }
}

TEST(Split, theTwoSidesShareTheirCornersToo) {
    Built built(sceneOf(ball(), true));
    built.split(3);
    ASSERT_EQ(built.tree.patches().size(), 16u);
    EXPECT_EQ(countVertices(built), 4u * 64u + 2u);
}

TEST(Split, namesRegionsAndParents) {
    Built built(test::randomScene(6, 2, 4, 2));
    built.split(3);
    forSplitElements(built, [&](NodeId id) {
        const ElementName name = built.tree.name(id);
        const surface::Region whole = built.tree.region(id);
        for (unsigned c = 0; c < 4; ++c) {
            const NodeId child = built.tree.child(id, c);
            const ElementName below = built.tree.name(child);
            EXPECT_EQ(below.object, name.object);
            EXPECT_EQ(below.patch, name.patch);
            EXPECT_EQ(below.back, name.back);
            EXPECT_EQ(below.path, surface::childPath(name.path, c));
            EXPECT_EQ(built.tree.parent(child), id);
            const surface::Region part = surface::childRegion(built.tree.surfaceOf(id), name.patch, whole,
                                                              built.tree.shape(id).split, c);
            EXPECT_EQ(built.tree.region(child).corners, part.corners);
        }
    });
}

TEST(Split, cornersRunCounterClockwiseSeenFromTheirSide) {
    std::vector<scene::Scene> scenes;
    scenes.push_back(sceneOf(ball(), true));
    scenes.push_back(sceneOf(ball(true), true));
    scenes.push_back(sceneOf(egg(), true));
    scenes.push_back(test::randomScene(7, 3, 8, 3));
    for (scene::Scene& scene : scenes) {
        Built built(std::move(scene));
        built.split(2);
        int backs = 0;
        for (std::uint32_t n = 0; n < built.tree.nodeCount(); ++n) {
            const NodeId id{n};
            if (built.tree.kind(id) != NodeKind::element) {
                continue;
            }
            backs += built.tree.name(id).back ? 1 : 0;
            const Shape& shape = built.tree.shape(id);
            const Vec3 last = shape.corners[shape.cornerCount == 3 ? 2 : 3];
            EXPECT_GT(glm::dot(shape.axis,
                               glm::cross(shape.corners[1] - shape.corners[0], last - shape.corners[0])),
                      0.0f);
            EXPECT_NEAR(glm::length(shape.axis), 1.0f, 1e-6f);
        }
        EXPECT_GT(backs, 0);
    }
}

TEST(Split, childrenTakeOverTheirParentsLight) {
    Built built(glowingBox());
    for (const NodeId id : built.tree.patches()) {
        hierarchy::Light& light = built.tree.light(id);
        light.irradiance = base::Rgb(1.0f, 2.0f, 3.0f);
        light.radiosity = light.emission + light.reflectance * light.irradiance;
    }
    built.split(2);
    for (const NodeId id : built.tree.patches()) {
        for (const NodeId leaf : built.leavesOf(id)) {
            const hierarchy::Light& light = built.tree.light(leaf);
            EXPECT_EQ(light.irradiance, base::Rgb(1.0f, 2.0f, 3.0f));
            EXPECT_EQ(light.emission, base::Rgb(2.0f));
            EXPECT_EQ(light.radiosity, light.emission + light.reflectance * light.irradiance);
        }
    }
}

TEST(Split, emissionLeavesTheFrontOnlyUnlessDoubleSided) {
    for (const bool doubleSided : {false, true}) {
        scene::Scene scene = scene::buildFurnace(0.5f, false);
        scene::addMaterial(scene, "lamp", base::Rgb(0.5f), base::Rgb(7.0f));
        scene.materials.back().doubleSided = doubleSided;
        const base::Box bounds = scene.bounds();
        const Vec3d middle = bounds.lower + Vec3d(0.5, 0.9, 0.5) * bounds.size();
        const Vec3d half = 0.03 * bounds.size();
        scene::addPolygons(scene, "lamp", static_cast<std::uint32_t>(scene.materials.size() - 1),
                           scene::boxFaces({middle.x - half.x, middle.y, middle.z - half.z},
                                           {middle.x + half.x, middle.y, middle.z + half.z}, scene::kBottom));
        const auto lamp = static_cast<std::uint32_t>(scene.objects.size() - 1);
        Built built(std::move(scene));
        built.split(1);
        const NodeId front = built.tree.patchNode(lamp, 0, false);
        const NodeId back = built.tree.patchNode(lamp, 0, true);
        ASSERT_NE(front, NodeId::none);
        ASSERT_NE(back, NodeId::none);
        EXPECT_EQ(built.tree.light(built.tree.child(front, 2)).emission, base::Rgb(7.0f));
        EXPECT_EQ(built.tree.light(built.tree.child(back, 2)).emission, base::Rgb(doubleSided ? 7.0f : 0.0f));
    }
}

TEST(Split, limits) {
    Built built(sceneOf(ball()));
    const NodeId first = built.tree.patches()[0];
    const double area = static_cast<double>(built.tree.shape(first).area);
    EXPECT_TRUE(built.tree.canSplit(first, 0.99 * area));
    EXPECT_FALSE(built.tree.canSplit(first, 1.01 * area));
    EXPECT_TRUE(built.tree.canSplit(built.tree.root(), 1e9)) << "a cluster";
    NodeId at = first;
    for (unsigned level = 0; level < surface::kMaxLevel; ++level) {
        ASSERT_TRUE(built.tree.canSplit(at, 0.0)) << level;
        const std::array<NodeId, 1> leaf{at};
        built.tree.split(leaf, built.executor);
        EXPECT_TRUE(built.tree.canSplit(at, 1e9)) << "it has children already";
        at = built.tree.child(at, 3);
    }
    EXPECT_FALSE(built.tree.canSplit(at, 0.0));
    EXPECT_EQ(surface::pathLevel(built.tree.name(at).path), surface::kMaxLevel);
    EXPECT_EQ(built.tree.leafCount(), 8 + 3 * surface::kMaxLevel);
}

}  // namespace
}  // namespace fluxwalk
