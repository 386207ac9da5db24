#include "core/transport/cluster_factor.h"

#include <gtest/gtest.h>

#include "core/transport/cluster_points.h"
#include "tests/support/built.h"
#include "tests/support/random_scenes.h"

// What clusters exchange, against brute force over all of their points.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Vec3;
using base::Vec3d;
using hierarchy::NodeKind;
using test::Built;

// Two heaps of quads and spheres, 2 m wide, `gap` metres between their middles.
scene::Scene makeHeaps(std::uint64_t key, double gap) {
    base::RandomStream random(key);
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(.5f), base::Rgb(1.0f));
    scene.materials[grey].doubleSided = true;
    for (const double x : {0.0, gap}) {
        scene::Quads quads;
        for (int i = 0; i < 12; ++i) {
            scene::Quad quad = test::randomQuad(random, 1.0, .5);
            for (Vec3d& corner : quad) {
                corner.x += x;
            }
            quads.push_back(quad);
        }
        scene::addPolygons(scene, "quads", grey, quads);
        for (int i = 0; i < 3; ++i) {
            const Vec3d at = test::randomPoint(random, 1.0) + Vec3d(x, 0.0, 0.0);
            scene.objects.push_back({"sphere", std::make_shared<surface::Sphere>(at, .15), grey});
        }
    }
    return scene;
}

// Clusters of at least `least` patches.
std::vector<NodeId> clustersOf(const Built& built, std::size_t least) {
    std::vector<NodeId> clusters;
    for (std::uint32_t i = 0; i < built.tree.nodeCount(); ++i) {
        if (built.tree.kind(NodeId{i}) == NodeKind::cluster &&
            built.tree.patchesBelow(NodeId{i}).size() >= least) {
            clusters.push_back(NodeId{i});
        }
    }
    return clusters;
}

bool areApart(const Built& built, NodeId a, NodeId b, float times) {
    const hierarchy::Shape& x = built.tree.shape(a);
    const hierarchy::Shape& y = built.tree.shape(b);
    return glm::distance(x.center, y.center) > times * (x.radius + y.radius);
}

// Unoccluded exchange in m2 from pairs of random points.
double exchangeOf(const Built& built, NodeId a, NodeId b, int pairs, std::uint64_t key) {
    const transport::ClusterSampler onA(built.tree, a);
    const transport::ClusterSampler onB(built.tree, b);
    base::RandomStream random(key);
    double sum = 0.0;
    for (int i = 0; i < pairs; ++i) {
        const base::Vec2d u = random.next2();
        const base::Vec2d v = random.next2();
        const transport::SurfaceSample p = onA.at((i + u.x) / pairs, u.y).point;
        const transport::SurfaceSample q = onB.at(v.x, v.y).point;
        const Vec3d d = q.position - p.position;
        const double r2 = glm::dot(d, d);
        sum += p.measure * q.measure * std::max(0.0, glm::dot(p.normal, d)) *
               std::max(0.0, -glm::dot(q.normal, d)) / (base::kPi * r2 * r2);
    }
    return sum / pairs * static_cast<double>(built.tree.shape(a).exposedArea()) *
           static_cast<double>(built.tree.shape(b).exposedArea());
}

}  // namespace

// The mean of what is above the horizon of cosines spread evenly over the ball's, over the squared distance.
TEST(PatchShare, isTheMeanOverABall) {
    const Vec3 at(1, 2, 3);
    for (const float radius : {.05f, .5f, 1.5f, 4.0f}) {
        for (const float cosine : {-1.0f, -.6f, -.2f, 0.0f, .1f, .5f, .95f, 1.0f}) {
            const Vec3 axis(0, 0, 1);
            const float distance = 2.0f;
            const float sine = std::sqrt(1.0f - cosine * cosine);
            const Vec3 center = at + distance * Vec3(sine, 0.0f, cosine);
            const double reach = std::min(1.0, static_cast<double>(radius / distance));
            double mean = 0.0;
            constexpr int kSteps = 2000;
            for (int i = 0; i < kSteps; ++i) {
                const double c = static_cast<double>(cosine) + reach * ((2.0 * i + 1.0) / kSteps - 1.0);
                mean += std::max(0.0, c) / kSteps;
            }
            const double squared = std::max(4.0, static_cast<double>(radius * radius));
            EXPECT_NEAR(static_cast<double>(transport::patchShare(at, axis, center, radius)), mean / squared,
                        1e-4 / squared)
                << radius << " " << cosine;
        }
    }
    EXPECT_EQ(transport::patchShare(at, Vec3(0, 1, 0), at, 1.0f), 0.0f);
}

TEST(PatchShare, addsUpOverTheExposedAreas) {
    const Built built(makeHeaps(3, 3.0));
    const std::vector<NodeId> clusters = clustersOf(built, 2);
    EXPECT_GT(clusters.size(), 20u);
    const hierarchy::Shape& other = built.tree.shape(built.tree.patches()[0]);
    for (const NodeId cluster : clusters) {
        double sum = 0.0;
        for (const NodeId patch : built.tree.patchesBelow(cluster)) {
            sum += static_cast<double>(built.tree.shape(patch).exposedArea() *
                                       transport::patchShare(built.tree.shape(patch), other));
        }
        EXPECT_NEAR(static_cast<double>(transport::sumShares(built.tree, cluster, other)), sum, 1e-5 * sum);
    }
}

// Each pair is estimated from few points; over many there is no bias, and their deviation is a sixth at most.
TEST(ClusterFactor, isThatOfAllPoints) {
    double all = 0.0;
    double exactAll = 0.0;
    double squares = 0.0;
    int pairs = 0;
    for (std::uint64_t key = 0; key < 4; ++key) {
        const Built built(makeHeaps(key, 4.0));
        const std::vector<NodeId> clusters = clustersOf(built, 6);
        for (const NodeId a : clusters) {
            for (const NodeId b : clusters) {
                if (base::index(a) >= base::index(b) || !areApart(built, a, b, 1.5f)) {
                    continue;
                }
                const double exact = exchangeOf(built, a, b, 4000, base::combine(key, base::index(a)));
                const double coupling = transport::computeClusterFactor(built.tree, a, b).coupling;
                all += coupling;
                exactAll += exact;
                squares += (coupling / exact - 1.0) * (coupling / exact - 1.0);
                ++pairs;
            }
        }
    }
    EXPECT_GT(pairs, 100);
    EXPECT_NEAR(all / exactAll, 1.0, .02);
    EXPECT_LT(std::sqrt(squares / pairs), 1.0 / 6.0);
}

TEST(ClusterFactor, isTheSameFromBothEnds) {
    const Built built(makeHeaps(9, 3.0));
    const std::vector<NodeId> clusters = clustersOf(built, 2);
    int pairs = 0;
    for (const NodeId a : clusters) {
        for (const NodeId b : built.tree.patches()) {
            const transport::PairFactor ab = transport::computeClusterFactor(built.tree, a, b);
            const transport::PairFactor ba = transport::computeClusterFactor(built.tree, b, a);
            EXPECT_EQ(ab.coupling, ba.coupling);
            EXPECT_EQ(ab.spreadA, ba.spreadB);
            EXPECT_EQ(ab.spreadB, ba.spreadA);
            EXPECT_EQ(ab.gradientB, ba.gradientA);
        }
        for (const NodeId b : clusters) {
            const transport::PairFactor ab = transport::computeClusterFactor(built.tree, a, b);
            const transport::PairFactor ba = transport::computeClusterFactor(built.tree, b, a);
            EXPECT_NEAR(ab.coupling, ba.coupling, 1e-12 * ab.coupling);
            EXPECT_EQ(ab.spreadA, ba.spreadB);
            pairs += ab.coupling > 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(pairs, 200);
}

// However clusters overlap, no patch gets more than if the whole ball about the other end glowed.
TEST(ClusterFactor, lightsNoPatchMoreThanABallCould) {
    const Built built(makeHeaps(5, 1.0));
    const std::vector<NodeId> clusters = clustersOf(built, 2);
    double most = 0.0;
    for (const NodeId a : clusters) {
        for (const NodeId b : clusters) {
            if (a == b) {
                continue;
            }
            const double coupling = transport::computeClusterFactor(built.tree, a, b).coupling;
            const hierarchy::Shape& other = built.tree.shape(b);
            const auto shares = static_cast<double>(transport::sumShares(built.tree, a, other));
            for (const NodeId patch : built.tree.patchesBelow(a)) {
                const auto share = static_cast<double>(transport::patchShare(built.tree.shape(patch), other));
                if (share > 0.0) {
                    most = std::max(most, coupling * share / shares);
                }
            }
        }
    }
    EXPECT_LE(most, 1.0 + 1e-5);
    EXPECT_GT(most, .2);
}

}  // namespace fluxwalk
