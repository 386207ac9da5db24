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

hierarchy::PatchTable tableOf(const Vec3& center, const Vec3& axis, float spread) {
    hierarchy::PatchTable table;
    for (int i = 0; i < 3; ++i) {
        table.center[static_cast<std::size_t>(i)] = {center[i]};
        table.axis[static_cast<std::size_t>(i)] = {axis[i]};
    }
    table.spread = {spread};
    table.area = {1.0f};
    return table;
}

// Part of the hemisphere's light that a ball at `cosine` to the normal sends, of which it fills the cone with
// `sine`.
double factorOfBall(double cosine, double sine) {
    constexpr int kSteps = 400;
    const double tilt = std::sqrt(1.0 - cosine * cosine);
    const double least = std::sqrt(1.0 - sine * sine);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double c = least + (1.0 - least) * (i + .5) / kSteps;
        for (int j = 0; j < kSteps; ++j) {
            const double turn = 2.0 * base::kPi * (j + .5) / kSteps;
            sum += std::max(0.0, c * cosine + std::sqrt(1.0 - c * c) * std::cos(turn) * tilt);
        }
    }
    return 2.0 * (1.0 - least) * sum / (kSteps * kSteps);
}

// Exact where the ball is above the horizon or touches, fitted where it is cut: within 4 % of what it would
// send from right above.
TEST(PatchShare, isThatOfABall) {
    const Vec3 at(1, 2, 3);
    const float distance = 2.0f;
    for (const float radius : {.05f, .5f, 1.0f, 1.5f, 1.9f, 2.0f}) {
        for (const float cosine : {-1.0f, -.6f, -.2f, 0.0f, .1f, .5f, .8f, .95f, 1.0f}) {
            const float across = std::sqrt(1.0f - cosine * cosine);
            const Vec3 center = at + distance * Vec3(across, 0.0f, cosine);
            const double sine = static_cast<double>(radius / distance);
            const double exact = factorOfBall(static_cast<double>(cosine), sine);
            const hierarchy::PatchTable table = tableOf(at, Vec3(0, 0, 1), 0.0f);
            const double share = static_cast<double>(transport::computeShare(table, 0, {center, radius}));
            const double factor = share * static_cast<double>(radius * radius);
            const bool isCut = std::abs(static_cast<double>(cosine)) < sine;
            EXPECT_NEAR(factor, exact, (isCut ? .04 : .001) * sine * sine) << radius << " " << cosine;
        }
    }
    // Inside the ball as on its surface, and curved patches see what is beyond their mean horizon.
    const hierarchy::PatchTable flat = tableOf(at, Vec3(0, 0, 1), 0.0f);
    EXPECT_FLOAT_EQ(transport::computeShare(flat, 0, {at + Vec3(0, 0, 1), 2.0f}), .25f);
    const transport::Ball below{at + Vec3(2, 0, -.5f), .01f};
    EXPECT_EQ(transport::computeShare(flat, 0, below), 0.0f);
    EXPECT_GT(transport::computeShare(tableOf(at, Vec3(0, 0, 1), .5f), 0, below), 0.0f);
}

TEST(PatchShare, addsUpOverTheExposedAreas) {
    const Built built(makeHeaps(3, 3.0));
    const std::vector<NodeId> clusters = clustersOf(built, 2);
    EXPECT_GT(clusters.size(), 20u);
    const NodeId source = built.tree.patches()[0];
    for (const NodeId cluster : clusters) {
        const transport::Ball other = transport::findBall(built.tree, cluster, source);
        double sum = 0.0;
        for (const NodeId patch : built.tree.patchesBelow(cluster)) {
            sum += static_cast<double>(
                built.tree.shape(patch).exposedArea() *
                transport::computeShare(built.tree.patchTable(), built.tree.firstPatchBelow(patch), other));
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
            const transport::Ball other = transport::findBall(built.tree, a, b);
            const auto shares = static_cast<double>(transport::sumShares(built.tree, a, other));
            for (const NodeId patch : built.tree.patchesBelow(a)) {
                const auto share = static_cast<double>(transport::computeShare(
                    built.tree.patchTable(), built.tree.firstPatchBelow(patch), other));
                if (share > 0.0) {
                    most = std::max(most, coupling * share / shares);
                }
            }
        }
    }
    EXPECT_LE(most, 1.0 + 1e-5);
    EXPECT_GT(most, .2);
}

// A ball of radius r sends r2 cos / d2 of its radiosity to a point whose horizon it is above.
TEST(ClusterFactor, aBallLightsEachElementOfARoom) {
    scene::Scene scene;
    scene::addMaterial(scene, "wall", base::Rgb(.5f));
    scene::addMaterial(scene, "lamp", base::Rgb(0.0f), base::Rgb(1.0f));
    scene::addPolygons(scene, "room", 0, scene::boxFaces({-2, 0, -2}, {2.3, 3, 2}, scene::kAllFaces, true));
    const Vec3d middle(.1, 2.8, .2);
    constexpr double kRadius = .15;
    scene.objects.push_back({"ball", std::make_shared<surface::Sphere>(middle, kRadius), 1});
    Built built(std::move(scene));
    built.split(3);
    NodeId ball = built.tree.patchNode(1, 0, false);
    while (built.tree.patchesBelow(ball).size() < 8) {
        ball = built.tree.parent(ball);
    }
    ASSERT_EQ(built.tree.patchesBelow(ball).size(), 8u);
    double off = 0.0;
    double all = 0.0;
    double sum = 0.0;
    for (std::uint32_t patch = 0; patch < 6; ++patch) {
        for (const NodeId id : built.leavesOf(built.tree.patchNode(0, patch, false))) {
            const surface::Region region = built.tree.region(id);
            double exact = 0.0;
            constexpr int kSide = 40;
            for (int i = 0; i < kSide * kSide; ++i) {
                const base::Vec2d st((i % kSide + .5) / kSide, (i / kSide + .5) / kSide);
                const surface::RegionPoint at = surface::mapToRegion(region, st);
                const surface::SurfacePoint x = built.tree.surfaceOf(id).evaluate(patch, at.uv);
                const Vec3d d = middle - x.position;
                const double r2 = glm::dot(d, d);
                exact += at.jacobian * x.jacobian / (kSide * kSide) * kRadius * kRadius *
                         glm::dot(x.normal, d) / (r2 * std::sqrt(r2));
            }
            const double coupling = transport::computeClusterFactor(built.tree, ball, id).coupling;
            off += std::abs(coupling - exact);
            sum += coupling;
            all += exact;
        }
    }
    EXPECT_NEAR(sum / all, 1.0, .002);
    EXPECT_LT(off / all, .06);
}

}  // namespace fluxwalk
