#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "core/hierarchy/local_frame.h"
#include "core/transport/exposed_part.h"
#include "core/transport/visibility.h"
#include "tests/support/statistics.h"
#include "tests/transport/polygon_pairs.h"

// Gradients of what arrives over partly shadowed and partly hidden elements.

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec2d;
using base::Vec3d;
using test::Built;
using test::Sample;

scene::Scene halfHidden(const test::Polygon& receiver) {
    return test::sceneOf({receiver,
                          {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}},
                          {{0.5, -3, 0.45}, {4, -3, 0.45}, {4, 4, 0.5}, {0.3, 4, 0.5}}});
}

// What the shadow adds to the relative gradients over both ends, by least squares over independent random
// rays.
std::array<Vec2d, 2> findTruth(const Built& built, NodeId a, NodeId b, int count) {
    base::RandomStream random(77);
    const std::array<transport::ElementSampler, 2> samplers{transport::ElementSampler(built.tree, a),
                                                            transport::ElementSampler(built.tree, b)};
    std::array<Vec2d, 2> all{};
    std::array<Vec2d, 2> seen{};
    double allWeight = 0.0;
    double seenWeight = 0.0;
    for (int i = 0; i < count; ++i) {
        const transport::SurfaceSample p = samplers[0].at(random.next2());
        const transport::SurfaceSample q = samplers[1].at(random.next2());
        const Vec3d d = q.position - p.position;
        const double r2 = glm::dot(d, d);
        const double weight = p.measure * q.measure * std::max(0.0, glm::dot(p.normal, d)) *
                              std::max(0.0, -glm::dot(q.normal, d)) / (r2 * r2);
        const rays::Ray ray = built.rays.segment(p.position, p.normal, q.position, q.normal);
        std::uint8_t blocked = 0;
        built.rays.occluded(std::span(&ray, 1), std::span(&blocked, 1));
        const double passed = blocked != 0 ? 0.0 : weight;
        allWeight += weight;
        seenWeight += passed;
        for (std::size_t end = 0; end < 2; ++end) {
            const Vec2d local = (end == 0 ? p : q).local;
            all[end] += weight * local;
            seen[end] += passed * local;
        }
    }
    std::array<Vec2d, 2> gradient{};
    for (std::size_t end = 0; end < 2; ++end) {
        const hierarchy::LocalFrame& f =
            hierarchy::localFrame(built.tree.shape(end == 0 ? a : b).cornerCount);
        const glm::dmat2 means(f.xx, f.xy, f.xy, f.yy);
        gradient[end] = glm::inverse(means) * (seen[end] / seenWeight - all[end] / allWeight);
    }
    return gradient;
}

void expectUnbiased(const test::Polygon& receiver, bool isBack) {
    std::array<std::array<Sample, 2>, 2> estimates;
    std::array<Vec2d, 2> truth{};
    constexpr std::uint64_t kSeeds = 250;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        Built built(halfHidden(receiver), 500 + seed);
        const NodeId a = built.tree.patchNode(0, 0, isBack);
        const NodeId b = built.tree.patchNode(1, 0, false);
        if (seed == 0) {
            truth = findTruth(built, a, b, 400'000);
        }
        const transport::VisibilitySample ab = transport::sampleVisibility(built.tree, built.rays, a, b);
        const transport::VisibilitySample ba = transport::sampleVisibility(built.tree, built.rays, b, a);
        EXPECT_EQ(ab.gradientA, ba.gradientB);
        EXPECT_EQ(ab.gradientB, ba.gradientA);
        for (int axis = 0; axis < 2; ++axis) {
            estimates[0][static_cast<std::size_t>(axis)].add(ab.gradientA[axis]);
            estimates[1][static_cast<std::size_t>(axis)].add(ab.gradientB[axis]);
        }
    }
    EXPECT_GT(glm::length(truth[0]), 0.5) << "the shadow's edge crosses the receiver";
    for (std::size_t end = 0; end < 2; ++end) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const Sample& s = estimates[end][axis];
            // A ratio of 64 rays, and the random rays of the truth.
            constexpr double kAllowance = 0.03;
            EXPECT_NEAR(s.mean(), truth[end][static_cast<int>(axis)], 4.5 * s.standardError() + kAllowance);
            EXPECT_LT(s.deviation(), 0.35) << "of one pair, in units of its mean";
        }
    }
}

TEST(ShadowGradient, agreesWithManyRays) {
    expectUnbiased({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, false);
    expectUnbiased({{0, 0, 0}, {1, 0.2, 0}, {0.1, 1, 0}}, false);
}

TEST(ShadowGradient, followsTheCornersOfBackSides) {
    expectUnbiased({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, true);
    expectUnbiased({{0, 0, 0}, {0.1, 1, 0}, {1, 0.2, 0}}, true);
}

TEST(ShadowGradient, isNoneInFullLight) {
    Built built(halfHidden({{-3, 0, 0}, {-2, 0, 0}, {-2, 1, 0}, {-3, 1, 0}}));
    const transport::VisibilitySample seen = transport::sampleVisibility(
        built.tree, built.rays, built.tree.patchNode(0, 0, false), built.tree.patchNode(1, 0, false));
    EXPECT_EQ(seen.mean, 1.0f);
    EXPECT_EQ(seen.gradientA, Vec2d(0.0));
}

// A block stands on a quarter of the floor, below a lamp.
scene::Scene blockOnFloor() {
    scene::Scene scene = test::sceneOf(
        {{{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}}, {{0, 3, 0}, {1, 3, 0}, {1, 3, 1}, {0, 3, 1}}});
    scene.objects[0].material = scene::addMaterial(scene, "dull", base::Rgb(0.5f));
    scene::addPolygons(scene, "block", 1, scene::boxFaces({1, 0, 0}, {3, 1, 2}, scene::kStanding));
    return scene;
}

TEST(ExposedPart, findsALinearFunctionOnWhatIsExposed) {
    Built built(blockOnFloor());
    const NodeId floor = built.tree.patchNode(0, 0, false);
    ASSERT_FLOAT_EQ(built.tree.shape(floor).exposed, 0.75f);
    const Vec2d slope(0.4, -0.25);
    double exposedMean = 0.0;
    const auto linear = [&](const transport::SurfaceSample& p) { return 2.0 + glm::dot(slope, p.local); };
    const transport::ElementSampler sampler(built.tree, floor);
    for (unsigned cell = 0; cell < 16; ++cell) {
        if ((static_cast<unsigned>(built.tree.shape(floor).exposedCells) >> cell & 1u) != 0) {
            exposedMean += linear(sampler.inCell(cell)) / 12.0;
        }
    }
    const transport::ExposedPart part = transport::findExposedPart(built.tree, floor, linear);
    EXPECT_NEAR(part.share, 0.75 * exposedMean / 2.0, 1e-12);
    EXPECT_NEAR(part.gradient.x, slope.x / exposedMean, 1e-12);
    EXPECT_NEAR(part.gradient.y, slope.y / exposedMean, 1e-12);
}

TEST(ExposedPart, leavesNothingOfWhatIsOnlyUnderTheBlock) {
    Built built(blockOnFloor());
    const NodeId floor = built.tree.patchNode(0, 0, false);
    const transport::ExposedPart part =
        transport::findExposedPart(built.tree, floor, [](const transport::SurfaceSample& p) {
            return p.position.x > 1 && p.position.x < 3 && p.position.z < 2 ? 1.0 : 0.0;
        });
    EXPECT_EQ(part.share, 0.0);
    EXPECT_EQ(part.gradient, Vec2d(0.0));
}

}  // namespace
}  // namespace fluxwalk
