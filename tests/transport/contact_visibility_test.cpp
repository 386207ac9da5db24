#include "core/transport/contact_visibility.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/transport/coefficients.h"
#include "tests/transport/polygon_pairs.h"
#include "tests/transport/visibility_truth.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using test::Built;
using test::Sample;
using transport::ContactSample;
using transport::sampleContact;

double couplingOf(const Built& built, NodeId a, NodeId b) {
    const transport::Query query{a, b, true};
    transport::Coefficient all;
    transport::CoefficientService(built.tree, built.rays).compute(std::span(&query, 1), std::span(&all, 1));
    return static_cast<double>(all.coupling);
}

Sample estimate(const Built& built, NodeId a, NodeId b, std::uint64_t keys) {
    Sample ratios;
    const double coupling = couplingOf(built, a, b);
    for (std::uint64_t key = 0; key < keys; ++key) {
        const ContactSample sample =
            sampleContact(built.tree, built.rays, a, b, coupling, base::mix(key + 1));
        EXPECT_GT(sample.rays, 400U);
        ratios.add(sample.seen / sample.sent);
    }
    return ratios;
}

// A screen stands across the common edge of floor and wall: what is left is two corners of unit squares,
// F = .200043776 each (ALGORITHMS 3.2).
TEST(ContactVisibility, isThatOfTheClosedForm) {
    const Built built(test::sceneOf({{{0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 0}},
                                     {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                     {{1, 0, 0}, {1, 3, 0}, {1, 3, 3}, {1, 0, 3}}}));
    const NodeId floor = built.tree.patchNode(0, 0, false);
    const NodeId wall = built.tree.patchNode(1, 0, false);
    const double seen = 2.0 * .200043776 / couplingOf(built, floor, wall);
    const Sample sample = estimate(built, floor, wall, 100);
    EXPECT_NEAR(sample.mean(), seen, 4.5 * sample.standardError());
    EXPECT_LT(sample.standardError(), .002);
}

// Floors of several shapes, a wall on their edge and a block that stands on the floor near it: what that
// hides of the floor, front or back, does not take part.
TEST(ContactVisibility, isThatOfTheExposedParts) {
    const std::vector<test::Polygon> floors{
        {{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}},
        {{0, 0, 0}, {0, 0, 4}, {3, 0, 5}, {4, 0, 0}},
        {{0, 0, 0}, {0, 0, 4}, {4, 0, 0}},
    };
    for (const test::Polygon& floor : floors) {
        for (const bool back : {false, true}) {
            test::Polygon turned = floor;
            if (back) {
                std::reverse(turned.begin(), turned.end());
            }
            scene::Scene scene = test::sceneOf({turned, {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}});
            scene.objects[0].material = scene::addMaterial(scene, "dull", base::Rgb(0.5f));
            scene::addPolygons(scene, "block", 1,
                               scene::boxFaces({.9, 0, .4}, {2.1, 1, 1.7}, scene::kStanding));
            const Built built(std::move(scene));
            const NodeId a = built.tree.patchNode(0, 0, back);
            const NodeId b = built.tree.patchNode(1, 0, false);
            ASSERT_LT(built.tree.shape(a).exposed, 1.0f);
            const test::Truth truth = test::findTruth(built, a, b, 4'000'000);
            const Sample sample = estimate(built, a, b, 60);
            EXPECT_NEAR(sample.mean(), truth.value, 4.5 * std::hypot(sample.standardError(), truth.error))
                << back << " " << floor.size();
            EXPECT_LT(std::hypot(sample.standardError(), truth.error), .004);
        }
    }
}

TEST(ContactVisibility, isTheSameInEveryRun) {
    const Built built(test::sceneOf({{{0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 0}},
                                     {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                     {{1, 0, 0}, {1, .5, 0}, {1, .5, 3}, {1, 0, 3}}}));
    const NodeId floor = built.tree.patchNode(0, 0, false);
    const NodeId wall = built.tree.patchNode(1, 0, false);
    const double coupling = couplingOf(built, floor, wall);
    const ContactSample first = sampleContact(built.tree, built.rays, floor, wall, coupling, 7);
    const ContactSample second = sampleContact(built.tree, built.rays, floor, wall, coupling, 7);
    EXPECT_EQ(first.seen, second.seen);
    EXPECT_EQ(first.sent, second.sent);
    EXPECT_GT(first.seen, 0.0);
    EXPECT_LT(first.seen, first.sent);
}

}  // namespace
}  // namespace fluxwalk
