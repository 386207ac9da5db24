#include "core/transport/cluster_points.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/scene/builders.h"
#include "tests/support/built.h"
#include "tests/support/curved_room.h"

// Points of clusters lie evenly on what is exposed of their surfaces.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Vec3d;
using test::Built;

constexpr unsigned kSide = 8;
constexpr int kRounds = 400;

// How many of the points from strata fall on each patch, weighed by their measure.
std::vector<double> countPoints(const Built& built, NodeId cluster, Vec3d& mean) {
    const transport::ClusterSampler sampler(built.tree, cluster);
    std::vector<double> counts(built.tree.patches().size(), 0.0);
    base::RandomStream random(11);
    mean = Vec3d(0.0);
    for (int round = 0; round < kRounds; ++round) {
        for (unsigned i = 0; i < kSide * kSide; ++i) {
            const double jx = random.next();
            const double jy = random.next();
            const transport::ClusterSampler::Place at = sampler.at((i + jx) / (kSide * kSide), jy);
            counts[at.patch] += at.point.measure;
            mean += at.point.measure * at.point.position;
            const transport::SurfaceSample same = sampler.inStratum(i, kSide, jx, jy);
            EXPECT_EQ(same.position, at.point.position);
        }
    }
    mean /= kRounds * kSide * kSide;
    return counts;
}

void expectEvenPoints(const Built& built, NodeId cluster) {
    Vec3d mean;
    const std::vector<double> counts = countPoints(built, cluster, mean);
    const auto all = static_cast<double>(built.tree.shape(cluster).exposedArea());
    const std::span<const NodeId> patches = built.tree.patches();
    double chiSquare = 0.0;
    int freedom = -1;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const std::uint32_t first = built.tree.firstPatchBelow(cluster);
        const bool isBelow = i >= first && i < first + built.tree.patchesBelow(cluster).size();
        const auto area = static_cast<double>(built.tree.shape(patches[i]).exposedArea());
        if (!isBelow || area <= 0.0) {
            EXPECT_EQ(counts[i], 0.0);
            continue;
        }
        const double expected = area / all * kRounds * kSide * kSide;
        if (expected > 5.0) {
            chiSquare += (counts[i] - expected) * (counts[i] - expected) / expected;
            ++freedom;
        }
    }
    EXPECT_GT(freedom, 10);
    // Strata make this smaller than independent points would.
    EXPECT_LT(chiSquare, freedom + 4.0 * std::sqrt(2.0 * freedom));
}

}  // namespace

TEST(ClusterPoints, lieEvenlyOnPlanarPatches) {
    const Built built(scene::buildTwoRooms());
    expectEvenPoints(built, built.tree.root());
}

TEST(ClusterPoints, lieEvenlyOnCurvedPatches) {
    const Built built(test::buildCurvedRoom());
    expectEvenPoints(built, built.tree.root());
}

// Inside a patch too: a floor of 1 m2, of which a box hides the middle quarter.
TEST(ClusterPoints, lieOnExposedPartsOnly) {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(.5f));
    const std::uint32_t glow = scene::addMaterial(scene, "glow", base::Rgb(.5f), base::Rgb(1.0f));
    scene::addPolygons(scene, "floor", grey, scene::boxFaces({0, 0, 0}, {1, 0, 1}, scene::kTop));
    scene::addPolygons(scene, "box", glow,
                       scene::boxFaces({.25, -.2, .25}, {.75, .5, .75}, scene::kAllFaces));
    const Built built(std::move(scene));
    const transport::ClusterSampler sampler(built.tree, built.tree.root());
    base::RandomStream random(5);
    int onFloor = 0;
    int left = 0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        const double across = random.next();
        const transport::ClusterSampler::Place at = sampler.at((i + random.next()) / kCount, across);
        if (built.tree.name(built.tree.patches()[at.patch]).object != 0) {
            continue;
        }
        ++onFloor;
        const Vec3d& p = at.point.position;
        EXPECT_FALSE(p.x > .25 && p.x < .75 && p.z > .25 && p.z < .75);
        left += p.x < .25 ? 1 : 0;
    }
    const NodeId floor = built.tree.patchNode(0, 0, false);
    EXPECT_NEAR(static_cast<double>(built.tree.shape(floor).exposed), .75, 1e-6);
    EXPECT_GT(onFloor, 2000);
    // A third of the frame; points of one patch are random across it.
    const double deviation = std::sqrt(onFloor * (1.0 / 3.0) * (2.0 / 3.0));
    EXPECT_NEAR(left, onFloor / 3.0, 4.0 * deviation);
}

TEST(ClusterPoints, standForAllOfTheArea) {
    const Built built(test::buildCurvedRoom());
    for (std::uint32_t i = 0; i < built.tree.nodeCount(); ++i) {
        const NodeId id{i};
        if (built.tree.kind(id) != hierarchy::NodeKind::cluster) {
            continue;
        }
        const transport::ClusterPoints points = transport::makeClusterPoints(built.tree, id);
        double area = 0.0;
        for (unsigned k = 0; k < transport::kClusterPoints; ++k) {
            area += points.area[k / base::kLanes][static_cast<int>(k % base::kLanes)];
        }
        const auto exposed = static_cast<double>(built.tree.shape(id).exposedArea());
        EXPECT_NEAR(area, exposed, .2 * exposed);
    }
}

}  // namespace fluxwalk
