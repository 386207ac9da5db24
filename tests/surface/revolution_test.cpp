// Cylinder, cone, frustum, disk and annulus: what is known of them in closed form.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/surface/curved_shapes.h"

namespace fluxwalk {
namespace {

using base::kPi;
using surface::Cone;
using surface::Cylinder;
using surface::Disk;
using surface::Surface;
using surface::SurfacePoint;
using test::Mat4d;
using test::Vec2d;
using test::Vec3d;

constexpr double kInf = std::numeric_limits<double>::infinity();
const Mat4d kHere(1.0);

double totalArea(const Surface& surface) {
    double sum = 0.0;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        sum += surface.area(patch, surface::wholePatch(surface.domain(patch)));
    }
    return sum;
}

Mat4d stretched(const Vec3d& scale) {
    Mat4d m(1.0);
    for (int i = 0; i < 3; ++i) {
        m[i][i] = scale[i];
    }
    return m;
}

TEST(Revolution, AreasInClosedForm) {
    EXPECT_NEAR(totalArea(Cylinder(kHere, .7, 1.9)), 2 * kPi * .7 * 1.9, 1e-14);
    EXPECT_NEAR(totalArea(Cone(kHere, .8, 0, 1.5)), kPi * .8 * std::hypot(.8, 1.5), 1e-14);
    EXPECT_NEAR(totalArea(Cone(kHere, .3, .8, 1.5)), kPi * 1.1 * std::hypot(.5, 1.5), 1e-14);
    EXPECT_NEAR(totalArea(Disk(kHere, 1.2)), kPi * 1.44, 1e-14);
    EXPECT_NEAR(totalArea(Disk(kHere, 1.2, .5)), kPi * (1.44 - .25), 1e-14);
    // An ellipse, and the wall over one: its circumference is 4 a E(e), 9.688448220547675 for axes 2 and 1.
    EXPECT_NEAR(totalArea(Disk(stretched({2, 5, .5}), 1)), kPi, 1e-14);
    EXPECT_NEAR(totalArea(Cylinder(stretched({2, 3, 1}), 1, 1)), 3 * 9.688448220547675, 1e-12);
    // A very flat one: all but its ends is straight.
    EXPECT_NEAR(totalArea(Cylinder(stretched({1, 1, 1e-4}), 1, 1)), 4.0, 1e-6);
}

TEST(Revolution, NormalsAtTheApexAreLimits) {
    const Cone cone(kHere, .8, 0, 1.5);
    for (std::uint32_t patch = 0; patch < 4; ++patch) {
        for (const double u : {0.0, .3, 1.0}) {
            const SurfacePoint apex = cone.evaluate(patch, {u, 1});
            EXPECT_EQ(apex.position, Vec3d(0, .75, 0));
            EXPECT_EQ(apex.jacobian, 0.0);
            EXPECT_LT(glm::distance(apex.normal, cone.evaluate(patch, {u, .5}).normal), 1e-15);
        }
    }
    EXPECT_EQ(Disk(kHere, 2).evaluate(1, {.5, 1}).normal, Vec3d(0, 1, 0));
}

TEST(Revolution, FrontsAndPlaces) {
    const Cylinder cylinder(kHere, 2, 3);
    EXPECT_LT(glm::distance(cylinder.evaluate(0, {0, 0}).position, Vec3d(2, -1.5, 0)), 1e-15);
    EXPECT_LT(glm::distance(cylinder.evaluate(0, {1, 1}).position, Vec3d(0, 1.5, -2)), 1e-15);
    EXPECT_LT(glm::distance(cylinder.evaluate(0, {0, 0}).normal, Vec3d(1, 0, 0)), 1e-15);
    EXPECT_LT(glm::distance(Cylinder(kHere, 2, 3, true).evaluate(0, {1, 0}).normal, Vec3d(-1, 0, 0)), 1e-15);
    EXPECT_EQ(Disk(kHere, 2, 0, true).evaluate(3, {.5, .5}).normal, Vec3d(0, -1, 0));
    // A mirror keeps outside what was outside.
    EXPECT_LT(
        glm::distance(Cylinder(stretched({-1, 1, 1}), 2, 3).evaluate(0, {1, 0}).normal, Vec3d(-1, 0, 0)),
        1e-15);
    EXPECT_EQ(Cylinder(kHere, 1, 1).kind(), "cylinder");
    EXPECT_EQ(Cone(kHere, 1, 0, 1).kind(), "cone");
    EXPECT_EQ(Disk(kHere, 1).kind(), "disk");
    EXPECT_FALSE(cylinder.exactKernel(true).has_value());
}

TEST(Revolution, TexcoordsAsBlenderUnwraps) {
    const Cylinder cylinder(kHere, 1, 2);
    const auto at = [](const Surface& s, std::uint32_t patch, const Vec3d& p) {
        return s.texcoord(patch, s.locate(patch, p), 0);
    };
    // v runs downwards in glTF: 1 at the bottom.
    EXPECT_LT(glm::distance(at(cylinder, 0, {1, -1, 0}), Vec2d(.5, 1)), 1e-15);
    EXPECT_LT(glm::distance(at(cylinder, 1, {0, 1, -1}), Vec2d(.75, 0)), 1e-15);
    EXPECT_LT(glm::distance(at(cylinder, 1, {-1, 0, 0}), Vec2d(1, .5)), 1e-15);
    EXPECT_LT(glm::distance(at(cylinder, 2, {-1, 0, 0}), Vec2d(0, .5)), 1e-15);
    EXPECT_LT(glm::distance(at(cylinder, 3, {0, 0, 1}), Vec2d(.25, .5)), 1e-15);
    const Disk disk(kHere, 2, .5);
    EXPECT_LT(glm::distance(at(disk, 0, {2, 0, 0}), Vec2d(1, .5)), 1e-15);
    EXPECT_LT(glm::distance(at(disk, 0, {0, 0, -1}), Vec2d(.5, .25)), 1e-15);
}

TEST(Revolution, RaysAlongTheAxisAndAlongGenerators) {
    const Cylinder cylinder(kHere, 1, 2);
    EXPECT_FALSE(cylinder.intersect({.3, 5, .2}, {0, -1, 0}, 0, kInf).has_value());
    EXPECT_FALSE(cylinder.intersect({1, 5, 0}, {0, -1, 0}, 0, kInf).has_value());
    const Cone cone(kHere, 1, 0, 1);
    // Along the axis through the apex; beside it onto the slope; parallel to a generator inside and outside.
    const auto apex = cone.intersect({0, 5, 0}, {0, -1, 0}, 0, kInf);
    ASSERT_TRUE(apex.has_value());
    EXPECT_NEAR(apex->t, 4.5, 1e-14);
    EXPECT_NEAR(cone.intersect({.25, 5, 0}, {0, -1, 0}, 0, kInf)->t, 4.75, 1e-14);
    const Vec3d slope = glm::normalize(Vec3d(1, -1, 0));
    const auto across = cone.intersect({-1.5, 1.5, 0}, slope, 0, kInf);
    EXPECT_FALSE(across.has_value() && across->t < 1.0);
    const auto within = cone.intersect({-.1, 0, 0}, -slope, 0, kInf);
    ASSERT_TRUE(within.has_value());
    EXPECT_LT(glm::distance(cone.evaluate(within->patch, within->uv).position, Vec3d(-.3, .2, 0)), 1e-14);
    // The mirrored nappe above the apex is no part of the cone.
    EXPECT_FALSE(cone.intersect({5, .9, 0}, {-1, 0, 0}, 0, kInf).has_value());
    // Flat rays onto a disk's edge miss it; through an annulus' hole nothing is hit.
    const Disk disk(kHere, 1, .5);
    EXPECT_FALSE(disk.intersect({3, 0, 0}, {-1, 0, 0}, 0, kInf).has_value());
    EXPECT_FALSE(disk.intersect({.4, 3, 0}, {0, -1, 0}, 0, kInf).has_value());
    EXPECT_NEAR(disk.intersect({.6, 3, 0}, {0, -2, 0}, 0, kInf)->t, 1.5, 1e-15);
}

// Near a tangent rays hit or miss as geometry says, to the square root of rounding.
TEST(Revolution, GrazingRays) {
    const Cylinder cylinder(kHere, 1, 2);
    for (int i = 1; i < 12; ++i) {
        const double off = std::pow(10.0, -i);
        EXPECT_FALSE(cylinder.intersect({-9, .3, 1 + off}, {1, 0, 0}, 0, kInf).has_value());
        const auto hit = cylinder.intersect({-9, .3, 1 - off}, {1, 0, 0}, 0, kInf);
        ASSERT_TRUE(hit.has_value()) << off;
        const double expected = 9 - std::sqrt(off * (2 - off));
        EXPECT_NEAR(hit->t, expected, 1e-15 / std::sqrt(off) + 1e-14) << off;
    }
}

// A million radii away: only the rounding of the ray itself is left.
TEST(Revolution, RaysFromVeryFar) {
    base::RandomStream random(4);
    for (const auto& shape : test::curvedShapes()) {
        const test::SurfacePtr surface = shape.make(kHere, false);
        int hits = 0;
        for (int i = 0; i < 500; ++i) {
            const std::uint32_t patch = test::randomPatch(*surface, random);
            const auto whole = surface::wholePatch(surface->domain(patch));
            const SurfacePoint p =
                surface->evaluate(patch, surface::mapToRegion(whole, .1 + .8 * random.next2()).uv);
            const Vec3d from = p.position + 1e6 * p.normal;
            const auto hit = surface->intersect(from, -p.normal, 0, kInf);
            ASSERT_TRUE(hit.has_value()) << shape.name;
            // The origin's own rounding is 1e-10; it moves the hit sideways.
            if (std::abs(hit->t - 1e6) < 1e-3) {
                ++hits;
                EXPECT_LT(glm::distance(surface->evaluate(hit->patch, hit->uv).position, p.position), 1e-9)
                    << shape.name;
            }
        }
        EXPECT_GT(hits, 200) << shape.name;
    }
}

TEST(RevolutionDeathTest, PreconditionsAreChecked) {
    EXPECT_DEATH(Cylinder(kHere, 0, 1), "check failed");
    EXPECT_DEATH(Cylinder(kHere, 1, -1), "check failed");
    EXPECT_DEATH(Cone(kHere, 1, -.5, 1), "check failed");
    EXPECT_DEATH(Cone(kHere, 0, 0, 1), "check failed");
    EXPECT_DEATH(Disk(kHere, 1, 1), "check failed");
    EXPECT_DEATH(surface::Torus(kHere, 1, 1.5), "check failed");
    EXPECT_DEATH(surface::Torus(stretched({1, 0, 1}), 1, .5), "check failed");
}

}  // namespace
}  // namespace fluxwalk
