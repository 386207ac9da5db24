// The torus' quartic against a search for its signs, and what is known of the torus in closed form.
#include "core/surface/torus.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_scenes.h"
#include "tests/surface/curved_shapes.h"

namespace fluxwalk {
namespace {

using base::kPi;
using surface::Torus;
using test::Mat4d;
using test::Vec2d;
using test::Vec3d;

constexpr double kInf = std::numeric_limits<double>::infinity();

// All hits of a ray, by starting again behind each.
std::vector<double> allHits(const Torus& torus, const Vec3d& from, const Vec3d& d, double tFar) {
    std::vector<double> hits;
    double t = 0.0;
    while (const auto hit = torus.intersect(from, d, t, tFar)) {
        t = hit->t;
        hits.push_back(t);
    }
    return hits;
}

double outsideness(double major, double minor, const Vec3d& p) {
    return std::hypot(std::hypot(p.x, p.z) - major, p.y) - minor;
}

TEST(Torus, AgreesWithASearchForSignChanges) {
    base::RandomStream random(1);
    constexpr int kSteps = 4000;
    constexpr double kFar = 8.0;
    int rays = 0;
    int crossings = 0;
    int four = 0;
    for (const double minor : {1.0, .9, .5, .1, .01}) {
        const Torus torus(Mat4d(1.0), 1.0, minor);
        for (int i = 0; i < 2000; ++i) {
            ++rays;
            Vec3d from = test::randomPoint(random, 2.0);
            Vec3d d = test::randomDirection(random);
            if (i % 2 == 0) {
                // Towards the tube, as most rays miss a thin one.
                const double angle = 2 * kPi * random.next();
                const Vec3d at =
                    Vec3d(std::cos(angle), 0, std::sin(angle)) + test::randomPoint(random, minor);
                d = glm::normalize(at - from);
            }
            if (i % 8 == 1) {
                d = glm::normalize(Vec3d(d.x, 0, d.z));  // flat, four crossings often
                from.y *= .4 * minor;
            }
            std::vector<double> expected;
            double last = outsideness(1.0, minor, from);
            for (int step = 1; step <= kSteps; ++step) {
                const double t = kFar * step / kSteps;
                const double now = outsideness(1.0, minor, from + t * d);
                if ((last < 0.0) != (now < 0.0)) {
                    double lower = kFar * (step - 1) / kSteps;
                    double upper = t;
                    for (int halving = 0; halving < 60; ++halving) {
                        const double middle = .5 * (lower + upper);
                        const double value = outsideness(1.0, minor, from + middle * d);
                        ((value < 0.0) == (last < 0.0) ? lower : upper) = middle;
                    }
                    expected.push_back(.5 * (lower + upper));
                }
                last = now;
            }
            std::vector<double> hits = allHits(torus, from, d, kFar);
            // Pairs that the search stepped over.
            for (std::size_t k = 0; k + 1 < hits.size() && hits.size() > expected.size();) {
                if (hits[k + 1] - hits[k] < kFar / kSteps &&
                    (k >= expected.size() || std::abs(hits[k] - expected[k]) > 1e-6)) {
                    const double middle = .5 * (hits[k] + hits[k + 1]);
                    EXPECT_LT(std::abs(outsideness(1.0, minor, from + middle * d)), 1e-3);
                    hits.erase(hits.begin() + static_cast<std::ptrdiff_t>(k),
                               hits.begin() + static_cast<std::ptrdiff_t>(k) + 2);
                } else {
                    ++k;
                }
            }
            ASSERT_EQ(hits.size(), expected.size()) << minor << ' ' << i;
            for (std::size_t k = 0; k < hits.size(); ++k) {
                // Signs are rounded: near a tangent a root is known to the square root of that.
                const double slope = std::abs(outsideness(1.0, minor, from + (hits[k] + 1e-6) * d) -
                                              outsideness(1.0, minor, from + (hits[k] - 1e-6) * d)) /
                                     2e-6;
                EXPECT_NEAR(hits[k], expected[k], 1e-14 / std::max(slope, 1e-6)) << minor << ' ' << slope;
            }
            crossings += static_cast<int>(hits.size());
            four += hits.size() == 4 ? 1 : 0;
        }
    }
    EXPECT_EQ(rays, 10000);
    EXPECT_GT(crossings, 9000);
    EXPECT_GT(four, 200);
}

TEST(Torus, SpecialRays) {
    const Torus torus(Mat4d(1.0), 1.0, .25);
    const auto expectHits = [&](const Vec3d& from, const Vec3d& d, const std::vector<double>& expected) {
        const std::vector<double> hits = allHits(torus, from, d, kInf);
        ASSERT_EQ(hits.size(), expected.size());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            EXPECT_NEAR(hits[i], expected[i], 1e-14);
        }
    };
    expectHits({-5, 0, 0}, {1, 0, 0}, {3.75, 4.25, 5.75, 6.25});
    expectHits({0, 5, 0}, {0, -1, 0}, {});
    expectHits({1, 5, 0}, {0, -1, 0}, {4.75, 5.25});
    expectHits({1, 0, 0}, {0, 2, 0}, {.125});
    expectHits({-5, 0, 1}, {1, 0, 0}, {5 - .75, 5 + .75});
    expectHits({-5, .25 + 1e-9, 0}, {1, 0, 0}, {});
    // In the plane that touches the torus from above along a circle: tangent wherever it passes.
    expectHits({-5, .25 + 1e-15, .3}, {1, 0, 0}, {});
}

// Thin and thick tubes, grazed at known distances.
TEST(Torus, GrazingRays) {
    for (const double minor : {1e-6, 1e-3, .1, 1.0}) {
        const Torus torus(Mat4d(1.0), 1.0, minor);
        for (int i = 1; i < 6; ++i) {
            const double off = minor * std::pow(10.0, -i);
            // Straight down past the outermost circle.
            const auto hit = torus.intersect({1 + minor - off, 3, 0}, {0, -1, 0}, 0, kInf);
            ASSERT_TRUE(hit.has_value()) << minor << ' ' << i;
            EXPECT_NEAR(hit->t, 3 - std::sqrt(off * (2 * minor - off)), 1e-15 * minor / off + 2e-15);
            EXPECT_FALSE(torus.intersect({1 + minor + off, 3, 0}, {0, -1, 0}, 0, kInf).has_value());
        }
    }
}

TEST(Torus, AreaInClosedForm) {
    const Torus torus(Mat4d(1.0), 1.1, .4);
    double sum = 0.0;
    for (std::uint32_t patch = 0; patch < 16; ++patch) {
        sum += torus.area(patch, surface::wholePatch(surface::PatchDomain::quad));
    }
    EXPECT_NEAR(sum / (4 * kPi * kPi * 1.1 * .4), 1.0, 1e-14);
}

TEST(Torus, OuterHalfIsConvexInnerHalfIsASaddle) {
    const Torus torus(Mat4d(1.0), 1.1, .4);
    const Torus within(Mat4d(1.0), 1.1, .4, true);
    for (std::uint32_t patch = 0; patch < 16; ++patch) {
        const Vec3d p = torus.evaluate(patch, Vec2d(.5)).position;
        const bool isOuter = std::hypot(p.x, p.z) > 1.1;
        EXPECT_EQ(torus.canSeeItself(patch, false), !isOuter);
        EXPECT_TRUE(torus.canSeeItself(patch, true));
        EXPECT_TRUE(within.canSeeItself(patch, false));
    }
}

TEST(Torus, TexcoordsAsBlenderUnwraps) {
    const Torus torus(Mat4d(1.0), 1.0, .25);
    const auto at = [&](std::uint32_t patch, const Vec3d& p) {
        return torus.texcoord(patch, torus.locate(patch, p), 0);
    };
    EXPECT_LT(glm::distance(at(0, {1.25, 0, 0}), Vec2d(.5, .5)), 1e-15);
    EXPECT_LT(glm::distance(at(0, {1, .25, 0}), Vec2d(.5, .25)), 1e-15);
    EXPECT_LT(glm::distance(at(4, {.75, 0, 0}), Vec2d(.5, 0)), 1e-15);
    EXPECT_LT(glm::distance(at(8, {.75, 0, 0}), Vec2d(.5, 1)), 1e-15);
    EXPECT_LT(glm::distance(at(13, {0, -.25, -1}), Vec2d(.75, .75)), 1e-15);
    EXPECT_LT(glm::distance(at(2, {-1.25, 0, 0}), Vec2d(0, .5)), 1e-15);
}

}  // namespace
}  // namespace fluxwalk
