#include "core/transport/isotropic_cluster.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/transport/cluster_factor.h"
#include "core/transport/coefficients.h"
#include "tests/support/built.h"
#include "tests/support/random_scenes.h"

// Clusters as volumes, against what holds for surfaces of random directions.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using hierarchy::NodeKind;
using test::Built;

// Cubes of 2 m full of small quads seen from both sides, `gap` metres between their middles along x, and a
// square of 4 m at either end that faces them, its middle at `across` in y and z.
scene::Scene makeClouds(const std::vector<double>& middles, int count, double end,
                        const base::Vec2d& across = base::Vec2d(.1, -.2)) {
    base::RandomStream random(4);
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", Rgb(.5f), Rgb(1.0f));
    scene.materials[grey].doubleSided = true;
    for (const double x : middles) {
        scene::Quads quads;
        for (int i = 0; i < count; ++i) {
            scene::Quad quad = test::randomQuad(random, 1.0, .1);
            for (Vec3d& corner : quad) {
                corner.x += x;
            }
            quads.push_back(quad);
        }
        scene::addPolygons(scene, "quads", grey, quads);
    }
    const std::uint32_t wall = scene::addMaterial(scene, "wall", Rgb(.5f));
    for (const double x : {-end, end}) {
        scene::Quad quad{Vec3d(x, -2, -2), Vec3d(x, 2, -2), Vec3d(x, 2, 2), Vec3d(x, -2, 2)};
        if (x > 0.0) {
            std::reverse(quad.begin(), quad.end());
        }
        for (Vec3d& corner : quad) {
            corner += Vec3d(0.0, across.x, across.y);
        }
        scene::addPolygons(scene, "wall", wall, {quad});
    }
    return scene;
}

// The cluster of all patches of an object.
NodeId clusterOf(const Built& built, std::uint32_t object) {
    for (std::uint32_t i = 0; i < built.tree.nodeCount(); ++i) {
        const NodeId id{i};
        if (built.tree.kind(id) != NodeKind::cluster) {
            continue;
        }
        std::size_t inside = 0;
        for (const NodeId patch : built.tree.patchesBelow(id)) {
            inside += built.tree.name(patch).object == object ? 1U : 0U;
        }
        std::size_t all = 0;
        for (const NodeId patch : built.tree.patches()) {
            all += built.tree.name(patch).object == object ? 1U : 0U;
        }
        if (inside == all && inside == built.tree.patchesBelow(id).size()) {
            return id;
        }
    }
    return NodeId::none;
}

// The side of a square that faces the middle, or the other one.
NodeId facingPatch(const Built& built, std::uint32_t object, bool isInner = true) {
    for (const bool back : {false, true}) {
        const NodeId id = built.tree.patchNode(object, 0, back);
        if (id != NodeId::none &&
            (glm::dot(built.tree.shape(id).axis, built.tree.shape(id).center) < 0.0f) == isInner) {
            return id;
        }
    }
    return NodeId::none;
}

}  // namespace

// A quarter of the area from any side is what random surfaces show: the sampled factor of the oriented model
// agrees.
TEST(IsotropicCluster, exchangesAsRandomSurfacesDo) {
    const Built built(makeClouds({-4.0, 4.0}, 300, 12.0));
    const NodeId a = clusterOf(built, 0);
    const NodeId b = clusterOf(built, 1);
    ASSERT_NE(a, NodeId::none);
    ASSERT_NE(b, NodeId::none);
    const transport::PairFactor clusters = transport::computeIsotropicFactor(built.tree, a, b);
    const transport::PairFactor sampled = transport::computeClusterFactor(built.tree, a, b);
    EXPECT_NEAR(clusters.coupling / sampled.coupling, 1.0, .15);
    const double areas = static_cast<double>(built.tree.shape(a).exposedArea()) *
                         static_cast<double>(built.tree.shape(b).exposedArea());
    const auto distance =
        static_cast<double>(glm::distance(built.tree.shape(a).center, built.tree.shape(b).center));
    EXPECT_NEAR(clusters.coupling, areas / (16.0 * base::kPi * distance * distance),
                1e-6 * clusters.coupling);

    const NodeId wall = facingPatch(built, 2);
    const transport::PairFactor element = transport::computeIsotropicFactor(built.tree, a, wall);
    EXPECT_NEAR(element.coupling / transport::computeClusterFactor(built.tree, a, wall).coupling, 1.0, .1);
    EXPECT_LT(element.spreadB, element.spreadA);
    const transport::PairFactor swapped = transport::computeIsotropicFactor(built.tree, wall, a);
    EXPECT_EQ(element.coupling, swapped.coupling);
    EXPECT_EQ(element.spreadA, swapped.spreadB);
    EXPECT_EQ(element.gradientB, swapped.gradientA);
}

TEST(IsotropicCluster, isNotSeenFromBehind) {
    const Built built(makeClouds({-4.0, 4.0}, 300, 2.0));
    const NodeId wall = facingPatch(built, 2, false);
    ASSERT_NE(wall, NodeId::none);
    EXPECT_GT(transport::computeIsotropicFactor(built.tree, clusterOf(built, 0), wall).coupling, 0.0);
    EXPECT_EQ(transport::computeIsotropicFactor(built.tree, clusterOf(built, 1), wall).coupling, 0.0);
}

// What rays say of a cloud in the middle, on average.
TEST(IsotropicCluster, dimsAsRaysAreBlocked) {
    constexpr int kRays = 10000;
    constexpr int kLines = 25;
    for (const int count : {200, 800}) {
        base::RandomStream random(2);
        int passed = 0;
        const Built cloud(makeClouds({0.0}, count, 12.0));
        for (int i = 0; i < kRays; ++i) {
            const base::Vec2d at = 1.8 * random.next2() - .9;
            passed += cloud.rays.isOccluded(
                          cloud.rays.segment({-11, at.x, at.y}, {1, 0, 0}, {11, at.x, at.y}, {-1, 0, 0}))
                          ? 0
                          : 1;
        }
        const double seen = static_cast<double>(passed) / kRays;
        double fog = 0.0;
        for (int i = 0; i < kLines; ++i) {
            const base::Vec2d u = random.next2();
            const base::Vec2d at((i % 5 + u.x) / 5.0, (i / 5 + u.y) / 5.0);
            const Built built(makeClouds({0.0}, count, 12.0, 1.8 * at - .9));
            const NodeId first = facingPatch(built, 1);
            const NodeId last = facingPatch(built, 2);
            const float one = transport::attenuate(built.tree, first, last);
            EXPECT_EQ(transport::attenuate(built.tree, last, first), one);
            fog += static_cast<double>(one) / kLines;
        }
        EXPECT_NEAR(fog, seen, .03) << count;
        testing::Test::RecordProperty("seen" + std::to_string(count), std::to_string(seen));
        testing::Test::RecordProperty("fog" + std::to_string(count), std::to_string(fog));
    }
}

// Beside a cloud the way is clear; the own fog of an end counts.
TEST(IsotropicCluster, dimsOnItsWayOnly) {
    const Built built(makeClouds({-4.0, 4.0}, 300, 12.0));
    const NodeId a = clusterOf(built, 0);
    const NodeId b = clusterOf(built, 1);
    const NodeId first = facingPatch(built, 2);
    const NodeId last = facingPatch(built, 3);
    const float toFirst = transport::attenuate(built.tree, a, first);
    const float toLast = transport::attenuate(built.tree, a, last);
    const float between = transport::attenuate(built.tree, a, b);
    const float through = transport::attenuate(built.tree, first, last);
    EXPECT_LT(toFirst, 1.0f);
    EXPECT_GT(toFirst, between);
    EXPECT_GT(between, toLast);
    EXPECT_GT(toLast, through);
    EXPECT_GT(through, 0.0f);
}

// No rays are cast for clusters.
TEST(IsotropicCluster, needsNoRays) {
    const Built built(makeClouds({-4.0, 4.0}, 50, 12.0));
    const std::vector<transport::Query> pairs{{clusterOf(built, 0), clusterOf(built, 1)},
                                              {clusterOf(built, 0), facingPatch(built, 2)}};
    std::vector<transport::Coefficient> oriented(2);
    std::vector<transport::Coefficient> isotropic(2);
    transport::CoefficientService(built.tree, built.rays).compute(pairs, oriented);
    transport::CoefficientService(built.tree, built.rays, transport::ClusterModel::isotropic)
        .compute(pairs, isotropic);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        EXPECT_GT(oriented[i].rays, 0);
        EXPECT_EQ(isotropic[i].rays, 0);
        EXPECT_GT(isotropic[i].coupling, 0.0f);
        EXPECT_EQ(isotropic[i].visibility, transport::attenuate(built.tree, pairs[i].a, pairs[i].b));
        EXPECT_TRUE(isotropic[i].isMixed);
    }
}

}  // namespace fluxwalk
