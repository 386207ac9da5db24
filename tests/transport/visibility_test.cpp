#include "core/transport/visibility.h"

#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/surface/sphere.h"
#include "tests/support/statistics.h"
#include "tests/transport/polygon_pairs.h"
#include "tests/transport/visibility_truth.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec2d;
using base::Vec3d;
using test::Built;
using test::Sample;
using test::Truth;
using transport::sampleVisibility;
using transport::VisibilitySample;

/// A pair whose visibility is asked for, and the scene around it.
struct Case {
    std::function<scene::Scene()> scene;
    std::function<NodeId(Built&)> a;
    std::function<NodeId(Built&)> b;
};

NodeId front(Built& built, std::uint32_t object) {
    return built.tree.patchNode(object, 0, false);
}

/// Difference of the mean estimate over many keys from the truth.
struct Bias {
    double value = 0.0;
    double error = 0.0;
    double truth = 0.0;
    double deviation = 0.0;  ///< of one estimate
};
Bias findBias(const Case& c, std::uint64_t seeds, transport::RayCount count = transport::RayCount::usual) {
    Sample estimates;
    Truth truth;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Built built(c.scene(), 1000 + seed);
        const NodeId a = c.a(built);
        const NodeId b = c.b(built);
        if (seed == 0) {
            truth = findTruth(built, a, b, 1'000'000);
        }
        const VisibilitySample seen = sampleVisibility(built.tree, built.rays, a, b, count);
        estimates.add(static_cast<double>(seen.mean));
    }
    return {estimates.mean() - truth.value, std::hypot(estimates.standardError(), truth.error), truth.value,
            estimates.deviation()};
}

// Two unit plates at distance 1 and, half way, a plate that hides what is beyond `edge` of x.
scene::Scene halfHidden(double edge, const test::Polygon& receiver) {
    return test::sceneOf({receiver,
                          {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}},
                          {{edge, -3, 0.45}, {4, -3, 0.45}, {4, 4, 0.5}, {edge, 4, 0.5}}});
}

const test::Polygon kUnit{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

NodeId object0(Built& built) {
    return front(built, 0);
}
NodeId object1(Built& built) {
    return front(built, 1);
}

constexpr double kSigmas = 4.5;
/// What the ratio of few rays and the first stage's verdict may cost.
constexpr double kAllowance = 0.004;

TEST(VisibilitySampling, isUnbiasedOverKeysWhereAPairIsPartlyBlocked) {
    for (const double edge : {0.25, 0.5, 0.7}) {
        const Case c{[edge] { return halfHidden(edge, kUnit); }, object0, object1};
        const Bias bias = findBias(c, 250);
        EXPECT_NEAR(bias.value, 0.0, kSigmas * bias.error + kAllowance);
        EXPECT_LT(bias.deviation, 0.04) << "64 stratified rays; .0625 at random";
    }
}

// Points are spread by area, whatever the parameterisation does.
TEST(VisibilitySampling, isUnbiasedOnATrapezium) {
    const Case c{[] {
                     return halfHidden(0.5, {{-0.2, 0, 0}, {1.2, 0, 0}, {0.6, 1, 0}, {0.45, 1, 0}});
                 },
                 object0, object1};
    const Case turned{[] {
                          return halfHidden(0.5, {{0.0, 0.4, 0}, {1, -0.3, 0}, {1, 1.3, 0}, {0, 0.5, 0}});
                      },
                      object0, object1};
    for (const Case& each : {c, turned}) {
        const Bias bias = findBias(each, 250);
        EXPECT_NEAR(bias.value, 0.0, kSigmas * bias.error + kAllowance);
    }
}

TEST(VisibilitySampling, isUnbiasedOnTrianglesAndBacks) {
    const Case triangle{[] {
                            return halfHidden(0.4, {{0, 0, 0}, {1, 0.2, 0}, {0.1, 1, 0}});
                        },
                        object0, object1};
    const Case back{[] {
                        return halfHidden(0.4, {{0, 0, 0}, {0, 1, 0}, {1, 0.2, 0}});
                    },
                    [](Built& built) { return built.tree.patchNode(0, 0, true); }, object1};
    for (const Case& each : {triangle, back}) {
        const Bias bias = findBias(each, 250);
        EXPECT_NEAR(bias.value, 0.0, kSigmas * bias.error + kAllowance);
        EXPECT_LT(bias.deviation, 0.05);
    }
}

TEST(VisibilitySampling, isUnbiasedOnCurvedElements) {
    for (const bool back : {false, true}) {
        const Case c{[back] {
                         scene::Scene scene = halfHidden(0.4, kUnit);
                         scene.objects[0].surface =
                             std::make_shared<surface::Sphere>(Vec3d(0.4, 0.4, -0.9), 0.9, back);
                         return scene;
                     },
                     [back](Built& built) {
                         // The octant that faces the plates best: +y, +z. As a back where normals point
                         // inwards.
                         NodeId best = NodeId::none;
                         for (std::uint32_t patch = 0; patch < 8; ++patch) {
                             const NodeId id = built.tree.patchNode(0, patch, back);
                             const auto z = built.tree.shape(id).axis.z;
                             best = best == NodeId::none || z > built.tree.shape(best).axis.z ? id : best;
                         }
                         return best;
                     },
                     object1};
        const Bias bias = findBias(c, 200);
        EXPECT_NEAR(bias.value, 0.0, kSigmas * bias.error + kAllowance);
    }
}

// Only what is outside the block that stands on the receiver takes part: on the front and on a back.
TEST(VisibilitySampling, respectsExposedCells) {
    for (const bool back : {false, true}) {
        const Case c{
            [back] {
                test::Polygon floor{{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}};
                if (back) {
                    std::reverse(floor.begin(), floor.end());
                }
                scene::Scene scene = test::sceneOf({floor, {{0, 3, 0}, {1, 3, 0}, {1, 3, 1}, {0, 3, 1}}});
                scene.objects[0].material = scene::addMaterial(scene, "dull", base::Rgb(0.5f));
                scene::addPolygons(scene, "block", 1,
                                   scene::boxFaces({1, 0, 0}, {3, 1, 2}, scene::kStanding));
                return scene;
            },
            [back](Built& built) { return built.tree.patchNode(0, 0, back); }, object1};
        Built built(c.scene());
        ASSERT_FLOAT_EQ(built.tree.shape(c.a(built)).exposed, 0.75f);
        const Bias bias = findBias(c, 250);
        EXPECT_NEAR(bias.value, 0.0, kSigmas * bias.error + kAllowance);
        EXPECT_GT(bias.truth, 0.7) << "the hidden part does not count as blocked";
    }
}

TEST(VisibilitySampling, isTheSameBothWaysAndInEveryRun) {
    Built built(test::randomScene(91, 3, 8, 3));
    built.split(1);
    Built again(test::randomScene(91, 3, 8, 3), 1, 2);
    again.split(1);
    std::vector<NodeId> leaves;
    for (const NodeId id : built.tree.patches()) {
        const std::vector<NodeId> below = built.leavesOf(id);
        leaves.insert(leaves.end(), below.begin(), below.end());
    }
    base::RandomStream random(92);
    int mixed = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto pick = [&] {
            return leaves[static_cast<std::size_t>(random.next() * static_cast<double>(leaves.size()))];
        };
        const NodeId a = pick();
        const NodeId b = pick();
        const VisibilitySample ab = sampleVisibility(built.tree, built.rays, a, b);
        for (const VisibilitySample& other : {sampleVisibility(built.tree, built.rays, b, a),
                                              sampleVisibility(again.tree, again.rays, a, b)}) {
            EXPECT_EQ(ab.mean, other.mean);
            EXPECT_EQ(ab.rays, other.rays);
            EXPECT_EQ(ab.isMixed, other.isMixed);
        }
        EXPECT_GE(ab.mean, 0.0f);
        EXPECT_LE(ab.mean, 1.0f);
        EXPECT_LE(ab.rays, transport::kNearRounds * transport::raysOf(transport::RayCount::usual));
        EXPECT_TRUE(ab.isMixed || ab.mean == 0.0f || ab.mean == 1.0f);
        mixed += ab.isMixed ? 1 : 0;
    }
    EXPECT_GT(mixed, 100);
}

// No stage of few rays ends the sampling where it happens to see all alike: that would pull visibilities near
// 0 and 1 to there.
TEST(VisibilitySampling, isNotBiasedNearTheEnds) {
    for (const double edge : {0.02, 0.97}) {
        const Case c{[edge] { return halfHidden(edge, kUnit); }, object0, object1};
        const Bias bias = findBias(c, 250);
        EXPECT_LT(std::abs(bias.value), 0.005);
    }
}

TEST(VisibilitySampling, castsAllRaysWhereNothingIsBlocked) {
    Built free(halfHidden(2.0, kUnit));
    EXPECT_EQ(sampleVisibility(free.tree, free.rays, object0(free), object1(free)).rays,
              transport::raysOf(transport::RayCount::usual));
}

// Fewer rays are as right in the mean, and more noisy by no more than the smaller number allows.
TEST(VisibilitySampling, isRightWithAnyNumberOfRays) {
    using transport::RayCount;
    const Case c{[] { return halfHidden(0.4, kUnit); }, object0, object1};
    std::array<double, 3> deviation{};
    for (const RayCount count : {RayCount::few, RayCount::usual, RayCount::many}) {
        Built free(halfHidden(2.0, kUnit));
        EXPECT_EQ(sampleVisibility(free.tree, free.rays, object0(free), object1(free), count).rays,
                  transport::raysOf(count));
        const Bias bias = findBias(c, 400, count);
        EXPECT_LT(std::abs(bias.value), kSigmas * bias.error) << transport::raysOf(count);
        deviation[static_cast<std::size_t>(count)] = bias.deviation;
        EXPECT_LT(bias.deviation, 0.5 / std::sqrt(static_cast<double>(transport::raysOf(count))));
    }
    EXPECT_GT(deviation[0], 1.5 * deviation[1]);
    EXPECT_GT(deviation[1], 1.5 * deviation[2]);
}

}  // namespace
}  // namespace fluxwalk
