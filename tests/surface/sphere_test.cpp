#include "core/surface/sphere.h"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/surface/region.h"

namespace fluxwalk {

namespace {

using base::kPi;
using base::Vec2d;
using base::Vec3d;
using surface::PatchDomain;
using surface::Region;
using surface::Sphere;
using surface::Surface;

const Region kWhole = surface::wholePatch(PatchDomain::triangle);

// Unit sphere under a rotation, three different scales and a shift.
base::Mat4d ellipsoidMap() {
    const double c = std::cos(.7);
    const double s = std::sin(.7);
    base::Mat4d m(1.0);
    m[0] = {2.0 * c, 2.0 * s, 0, 0};
    m[1] = {-s, c, 0, 0};
    m[2] = {0, 0, .5, 0};
    m[3] = {1, -2, 3, 1};
    return m;
}

// Calls visit(region) for all elements of `level` below a region.
template <class Visit>
void forElements(const Surface& surface, std::uint32_t patch, const Region& region, unsigned level,
                 const Visit& visit) {
    if (level == 0) {
        visit(region);
        return;
    }
    for (unsigned child = 0; child < 4; ++child) {
        forElements(surface, patch,
                    surface::childRegion(surface, patch, region, surface::Split::quarters, child), level - 1,
                    visit);
    }
}

template <class Measure>
double sumOver(const Surface& surface, unsigned level, const Measure& measure) {
    double sum = 0.0;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        forElements(surface, patch, kWhole, level, [&](const Region& r) { sum += measure(patch, r); });
    }
    return sum;
}

Vec2d interior(const Region& region, base::RandomStream& random) {
    return surface::mapToRegion(region, random.next2()).uv;
}

bool sameBits(const Vec3d& a, const Vec3d& b) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(std::array{a.x, a.y, a.z}) ==
           std::bit_cast<std::array<std::uint64_t, 3>>(std::array{b.x, b.y, b.z});
}

}  // namespace

// Check 10 of ALGORITHMS section 4.
TEST(Sphere, trueAreaAtEveryLevel) {
    const Sphere sphere(Vec3d(1, 2, 3), .7);
    for (unsigned level = 0; level < 6; ++level) {
        const double area =
            sumOver(sphere, level, [&](auto patch, const Region& r) { return sphere.area(patch, r); });
        EXPECT_NEAR(area / (4.0 * kPi * .49), 1.0, 1e-12) << level;
    }
}

TEST(Sphere, polygonAreasOfTheOctahedron) {
    const Sphere sphere(Vec3d(0.0), 1.0);
    constexpr std::array<double, 6> kExpected{.5513, .8290, .9513, .9874, .9968, .9992};
    for (unsigned level = 0; level < kExpected.size(); ++level) {
        const double area = sumOver(sphere, level, [&](auto patch, const Region& r) {
            const Vec3d a = sphere.evaluate(patch, r.corners[0]).position;
            const Vec3d b = sphere.evaluate(patch, r.corners[1]).position;
            const Vec3d c = sphere.evaluate(patch, r.corners[2]).position;
            return .5 * glm::length(glm::cross(b - a, c - a));
        });
        EXPECT_NEAR(area / (4.0 * kPi), kExpected[level], 1e-4) << level;
    }
}

TEST(Sphere, cornersRunCounterClockwiseAsSeenFromTheFront) {
    base::Mat4d mirror = ellipsoidMap();
    mirror[1] = -mirror[1];
    for (const Sphere& sphere :
         {Sphere(Vec3d(0.0), 1.0), Sphere(Vec3d(0.0), 1.0, true), Sphere(mirror), Sphere(mirror, true)}) {
        for (std::uint32_t patch = 0; patch < 8; ++patch) {
            const Vec3d a = sphere.evaluate(patch, kWhole.corners[0]).position;
            const Vec3d b = sphere.evaluate(patch, kWhole.corners[1]).position;
            const Vec3d c = sphere.evaluate(patch, kWhole.corners[2]).position;
            const Vec3d normal = sphere.evaluate(patch, Vec2d(1.0 / 3.0)).normal;
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a), normal), 0.0) << patch;
        }
    }
}

TEST(Sphere, edgesSplitAtTheirGeodesicMiddle) {
    const Sphere sphere(Vec3d(0.0), 1.0);
    base::RandomStream random(1);
    for (int i = 0; i < 200; ++i) {
        const auto patch = static_cast<std::uint32_t>(i % 8);
        const Vec2d a = interior(kWhole, random);
        const Vec2d b = interior(kWhole, random);
        const Vec2d split = sphere.splitPoint(patch, a, b);
        EXPECT_EQ(split, sphere.splitPoint(patch, b, a));
        const Vec3d expected =
            glm::normalize(sphere.evaluate(patch, a).position + sphere.evaluate(patch, b).position);
        EXPECT_LT(glm::distance(sphere.evaluate(patch, split).position, expected), 1e-14);
    }
}

// Points on the common edges of octants, reached by splitting: equal to the last bit from both sides.
TEST(Sphere, neighbouringOctantsShareTheirEdgesBitwise) {
    for (const Sphere& sphere :
         {Sphere(Vec3d(.1, .2, .3), .37), Sphere(ellipsoidMap()), Sphere(Vec3d(0.0), 1.0)}) {
        const auto expectSameEdge = [&](std::uint32_t p, Vec2d a0, Vec2d a1, std::uint32_t q, Vec2d b0,
                                        Vec2d b1) {
            const auto descend = [&](const auto& self, Vec2d s0, Vec2d s1, Vec2d t0, Vec2d t1,
                                     int level) -> void {
                const Vec2d s = sphere.splitPoint(p, s0, s1);
                const Vec2d t = sphere.splitPoint(q, t0, t1);
                EXPECT_TRUE(sameBits(sphere.evaluate(p, s).position, sphere.evaluate(q, t).position))
                    << p << ' ' << q << ' ' << level;
                if (level < 6) {
                    self(self, s0, s, t0, t, level + 1);
                    self(self, s, s1, t, t1, level + 1);
                }
            };
            EXPECT_TRUE(sameBits(sphere.evaluate(p, a0).position, sphere.evaluate(q, b0).position))
                << p << ' ' << q;
            EXPECT_TRUE(sameBits(sphere.evaluate(p, a1).position, sphere.evaluate(q, b1).position))
                << p << ' ' << q;
            descend(descend, a0, a1, b0, b1, 0);
        };
        const Vec2d pole(0, 0);
        const Vec2d first(1, 0);
        const Vec2d second(0, 1);
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t next = (k + 1) % 4;
            expectSameEdge(k, pole, second, next, pole, first);
            expectSameEdge(k + 4, pole, first, next + 4, pole, second);
            expectSameEdge(k, first, second, k + 4, second, first);
        }
    }
}

TEST(Sphere, boundsHoldAllPointsAndNormals) {
    const Sphere round(Vec3d(1, 2, 3), .7, true);
    const Sphere oblong(ellipsoidMap());
    base::RandomStream random(2);
    for (const Sphere* sphere : {&round, &oblong}) {
        for (std::uint32_t patch = 0; patch < 8; ++patch) {
            for (unsigned level = 0; level < 4; ++level) {
                forElements(*sphere, patch, kWhole, level, [&](const Region& region) {
                    const surface::RegionBounds bounds = sphere->bounds(patch, region);
                    for (int i = 0; i < 8; ++i) {
                        const Vec2d uv =
                            i < 3 ? region.corners[static_cast<std::size_t>(i)] : interior(region, random);
                        const surface::SurfacePoint p = sphere->evaluate(patch, uv);
                        for (int axis = 0; axis < 3; ++axis) {
                            ASSERT_GE(p.position[axis], bounds.box.lower[axis] - 1e-12);
                            ASSERT_LE(p.position[axis], bounds.box.upper[axis] + 1e-12);
                        }
                        ASSERT_LE(base::NormalCone::angleBetween(p.normal, bounds.normals.axis),
                                  bounds.normals.halfAngle + 1e-12);
                    }
                });
            }
        }
    }
    // Tight enough to be of use: the box of an element of a sixteenth of a radian is not much larger.
    const Region small = surface::regionOf(round, 0, 0b1'00'01'11'10);
    EXPECT_LT(round.bounds(0, small).box.diagonal(), .7 * .25);
    EXPECT_LT(round.bounds(0, small).normals.halfAngle, .1);
}

// The area measure integrates to the true area, on the sphere and on the ellipsoid.
TEST(Sphere, jacobianIntegratesToTheArea) {
    const Sphere round(Vec3d(1, 2, 3), .7);
    const Sphere oblong(ellipsoidMap());
    const Region region = surface::regionOf(round, 5, 0b1'11);
    for (const Sphere* sphere : {&round, &oblong}) {
        constexpr int kN = 200;
        double sum = 0.0;
        for (int i = 0; i < kN; ++i) {
            for (int j = 0; j < kN; ++j) {
                const surface::RegionPoint at = surface::mapToRegion(region, {(i + .5) / kN, (j + .5) / kN});
                sum += at.jacobian * sphere->evaluate(5, at.uv).jacobian / (kN * kN);
            }
        }
        EXPECT_NEAR(sum / sphere->area(5, region), 1.0, 5e-5);
    }
}

// A prolate spheroid, whose area is known: 2 pi a^2 (1 + c/(a e) asin e).
TEST(Sphere, areaOfASpheroid) {
    base::Mat4d m(1.0);
    m[1][1] = 2.0;
    const Sphere spheroid(m);
    const double e = std::sqrt(1.0 - .25);
    const double expected = 2.0 * kPi * (1.0 + 2.0 / e * std::asin(e));
    for (unsigned level = 0; level < 4; ++level) {
        const double area =
            sumOver(spheroid, level, [&](auto patch, const Region& r) { return spheroid.area(patch, r); });
        EXPECT_NEAR(area / expected, 1.0, level == 0 ? 2e-4 : 1e-6) << level;
    }
}

TEST(Sphere, ellipsoidNormalsAreGradients) {
    const Sphere ellipsoid(ellipsoidMap());
    base::RandomStream random(3);
    for (std::uint32_t patch = 0; patch < 8; ++patch) {
        const Vec2d uv = .8 * interior(kWhole, random) + Vec2d(.05);
        const surface::SurfacePoint p = ellipsoid.evaluate(patch, uv);
        constexpr double kStep = 1e-6;
        const Vec3d du = (ellipsoid.evaluate(patch, uv + Vec2d(kStep, 0)).position - p.position) / kStep;
        const Vec3d dv = (ellipsoid.evaluate(patch, uv + Vec2d(0, kStep)).position - p.position) / kStep;
        EXPECT_NEAR(glm::dot(glm::normalize(du), p.normal), 0.0, 1e-5);
        EXPECT_NEAR(glm::dot(glm::normalize(dv), p.normal), 0.0, 1e-5);
        EXPECT_NEAR(glm::length(glm::cross(du, dv)) / p.jacobian, 1.0, 1e-5);
        EXPECT_GT(glm::dot(p.normal, p.position - Vec3d(1, -2, 3)), 0.0);
    }
}

TEST(Sphere, locateInvertsEvaluate) {
    const Sphere ellipsoid(ellipsoidMap());
    base::RandomStream random(4);
    for (int i = 0; i < 400; ++i) {
        const auto patch = static_cast<std::uint32_t>(i % 8);
        const Vec2d uv = interior(kWhole, random);
        EXPECT_LT(glm::distance(ellipsoid.locate(patch, ellipsoid.evaluate(patch, uv).position), uv), 1e-13);
    }
}

TEST(Sphere, raysFromOutsideInsideAndPast) {
    const Sphere sphere(Vec3d(1, 0, 0), 2.0);
    const double inf = std::numeric_limits<double>::infinity();
    const auto outside = sphere.intersect({1, 0, 10}, {0, 0, -2}, 0.0, inf);
    ASSERT_TRUE(outside.has_value());
    EXPECT_NEAR(outside->t, 4.0, 1e-14);
    EXPECT_LT(glm::distance(sphere.evaluate(outside->patch, outside->uv).position, Vec3d(1, 0, 2)), 1e-14);
    const auto within = sphere.intersect({1, 0, 0}, {0, 1, 0}, 0.0, inf);
    ASSERT_TRUE(within.has_value());
    EXPECT_NEAR(within->t, 2.0, 1e-14);
    EXPECT_FALSE(sphere.intersect({1, 0, 10}, {0, 0, 1}, 0.0, inf).has_value());
    EXPECT_FALSE(sphere.intersect({1, 0, 10}, {0, 0, -1}, 0.0, 7.9).has_value());
    EXPECT_FALSE(sphere.intersect({1, 2.0001, 10}, {0, 0, -1}, 0.0, inf).has_value());
    EXPECT_FALSE(sphere.intersect({1, 0, 10}, {0, 0, 0}, 0.0, inf).has_value());
    // From a point on the sphere, behind tNear: inwards the far side, outwards nothing.
    EXPECT_NEAR(sphere.intersect({1, 0, 2}, {0, 0, -1}, 1e-9, inf)->t, 4.0, 1e-14);
    EXPECT_FALSE(sphere.intersect({1, 0, 2}, {0, 0, 1}, 1e-9, inf).has_value());
    // Grazing: within rounding of the tangent it may hit or miss, but a hit lies on the sphere.
    for (int i = -20; i <= 20; ++i) {
        const auto graze = sphere.intersect({1, 2.0 + i * 1e-16, 1e3}, {0, 0, -1}, 0.0, inf);
        if (graze) {
            EXPECT_LT(glm::distance(sphere.evaluate(graze->patch, graze->uv).position, Vec3d(1, 2, 0)), 1e-4);
        }
    }
}

// From far away the hit keeps its digits.
TEST(Sphere, raysFromFarAwayHitTheSurface) {
    const Sphere ellipsoid(ellipsoidMap());
    base::RandomStream random(5);
    for (int i = 0; i < 500; ++i) {
        const auto patch = static_cast<std::uint32_t>(i % 8);
        const surface::SurfacePoint p = ellipsoid.evaluate(patch, interior(kWhole, random));
        const Vec3d tilt(random.next() - .5, random.next() - .5, random.next() - .5);
        const Vec3d from = p.position + 1e4 * glm::normalize(p.normal + tilt);
        const auto hit = ellipsoid.intersect(from, glm::normalize(p.position - from), 0.0, 1e9);
        ASSERT_TRUE(hit.has_value());
        EXPECT_LT(glm::distance(ellipsoid.evaluate(hit->patch, hit->uv).position, p.position), 1e-9);
    }
}

TEST(Sphere, exactKernelOnTheConcaveSideOnly) {
    const Sphere outside(Vec3d(0.0), 2.0);
    const Sphere inside(Vec3d(0.0), 2.0, true);
    EXPECT_FALSE(outside.exactKernel(false).has_value());
    EXPECT_NEAR(outside.exactKernel(true).value(), 1.0 / (16.0 * kPi), 1e-15);
    EXPECT_NEAR(inside.exactKernel(false).value(), 1.0 / (16.0 * kPi), 1e-15);
    EXPECT_FALSE(inside.exactKernel(true).has_value());
    EXPECT_FALSE(Sphere(ellipsoidMap(), true).exactKernel(false).has_value());
    EXPECT_TRUE(inside.canSeeItself(0, false));
    EXPECT_FALSE(outside.canSeeItself(0, false));
    EXPECT_TRUE(outside.canSeeItself(0, true));
    // It is what the definition gives for any two points inside.
    base::RandomStream random(6);
    for (int i = 0; i < 100; ++i) {
        const surface::SurfacePoint x =
            inside.evaluate(static_cast<std::uint32_t>(i % 8), interior(kWhole, random));
        const surface::SurfacePoint y =
            inside.evaluate(static_cast<std::uint32_t>(i / 8 % 8), interior(kWhole, random));
        const Vec3d r = y.position - x.position;
        const double r2 = glm::dot(r, r);
        if (r2 > 1e-3) {
            EXPECT_NEAR(glm::dot(x.normal, r) * -glm::dot(y.normal, r) / (kPi * r2 * r2), 1.0 / (16.0 * kPi),
                        1e-12);
        }
    }
}

TEST(Sphere, texcoordsAreContinuousWithinAPatchAndCoverTheMap) {
    const Sphere outside(Vec3d(0.0), 1.0);
    const Sphere within(Vec3d(0.0), 1.0, true);
    double covered = 0.0;
    for (std::uint32_t patch = 0; patch < 8; ++patch) {
        // Away from the pole, where the longitude is free.
        const Vec2d a = outside.texcoord(patch, {1, 0}, 0);
        const Vec2d b = outside.texcoord(patch, {0, 1}, 0);
        EXPECT_NEAR(std::abs(a.x - b.x), .25, 1e-12);
        EXPECT_NEAR(a.y, .5, 1e-12);
        EXPECT_NEAR(outside.texcoord(patch, {0, 0}, 0).y, patch < 4 ? 0.0 : 1.0, 1e-12);
        const Vec2d middle = outside.texcoord(patch, Vec2d(1.0 / 3.0), 0);
        EXPECT_GT(middle.x, std::min(a.x, b.x));
        EXPECT_LT(middle.x, std::max(a.x, b.x));
        EXPECT_GE(middle.x, 0.0);
        EXPECT_LE(middle.x, 1.0);
        covered += std::abs(a.x - b.x);
        // The same point of space has the same coordinate seen from inside.
        const Vec3d point = outside.evaluate(patch, {.2, .5}).position;
        EXPECT_LT(glm::distance(within.texcoord(patch, within.locate(patch, point), 0),
                                outside.texcoord(patch, {.2, .5}, 0)),
                  1e-12);
    }
    EXPECT_NEAR(covered, 2.0, 1e-12);
}

}  // namespace fluxwalk
