#include <gtest/gtest.h>

#include "core/base/normal_cone.h"
#include "tests/surface/projectables.h"

// What bounds a projected surface, and what happens where projection fails.
namespace fluxwalk {

namespace {

using base::kPi;
using base::NormalCone;
using base::Vec2d;
using base::Vec3d;
using surface::Region;
using surface::SurfacePoint;
using test::areaAt;
using test::forElements;
using test::inRegion;
using test::shapes;
using test::wholeOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST(ProjectedBounds, boundsHoldAllPointsAndNormals) {
    base::RandomStream random(3);
    for (const surface::ProjectedSurface* surface : shapes().all()) {
        double coneAtFour = 0.0;
        double widest = 0.0;
        double boxAtFour = 0.0;
        double count = 0.0;
        for (unsigned level = 0; level < 5; ++level) {
            forElements(*surface, level, [&](auto patch, const Region& region) {
                const surface::RegionBounds bounds = surface->bounds(patch, region);
                double extent = 0.0;
                const Vec3d corner = surface->evaluate(patch, region.corners[0]).position;
                for (std::size_t i = 0; i < 10; ++i) {
                    const Vec2d uv =
                        i < 4 ? region.corners[i % region.cornerCount] : inRegion(region, random);
                    const SurfacePoint p = surface->evaluate(patch, uv);
                    extent = std::max(extent, glm::distance(p.position, corner));
                    for (int axis = 0; axis < 3; ++axis) {
                        ASSERT_GE(p.position[axis], bounds.box.lower[axis]) << level;
                        ASSERT_LE(p.position[axis], bounds.box.upper[axis]) << level;
                    }
                    ASSERT_LE(NormalCone::angleBetween(p.normal, bounds.normals.axis),
                              bounds.normals.halfAngle)
                        << level;
                }
                if (level == 4) {
                    coneAtFour += bounds.normals.halfAngle;
                    widest = std::max(widest, bounds.normals.halfAngle);
                    boxAtFour += bounds.box.diagonal() / extent;
                    count += 1.0;
                }
            });
        }
        // Tight enough to be of use.
        EXPECT_LT(coneAtFour / count, .4);
        EXPECT_LT(widest, 1.0);
        EXPECT_LT(boxAtFour / count, 3.0);
    }
}

// Against random rays that know nothing of patches: by Crofton's formula, a random line through a sphere of
// area S meets a surface of area A within it 2 A / S times on average; and chords measure the volume.
TEST(ProjectedBounds, areaAndVolumeOfTheUnionMatchRandomLines) {
    const test::ProjectedUnion& blobs = shapes().blobs;
    double volume = 0.0;
    forElements(blobs.surface, 2, [&](auto patch, const Region& r) {
        // Midpoint rule over 4 x 4 parts.
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const surface::RegionPoint at = surface::mapToRegion(r, {(i + .5) / 4, (j + .5) / 4});
                const SurfacePoint p = blobs.surface.evaluate(patch, at.uv);
                volume += at.jacobian * p.jacobian * glm::dot(p.position, p.normal) / (16.0 * 3.0);
            }
        }
    });
    const double area = areaAt(blobs.surface, 0);
    const surface::Box box = blobs.object->bounds();
    const double radius = .5 * box.diagonal();
    base::RandomStream random(6);
    const auto onSphere = [&] {
        const double z = 2.0 * random.next() - 1.0;
        const double phi = 2.0 * kPi * random.next();
        const double r = std::sqrt(1.0 - z * z);
        return box.center() + radius * Vec3d(r * std::cos(phi), r * std::sin(phi), z);
    };
    constexpr int kLines = 200000;
    std::array<double, 2> sum{};
    std::array<double, 2> squares{};
    for (int i = 0; i < kLines; ++i) {
        // Two uniform points of a sphere make a uniform line.
        const Vec3d from = onSphere();
        const Vec3d direction = glm::normalize(onSphere() - from);
        double crossings = 0.0;
        double length = 0.0;
        double t = 0.0;
        while (const auto hit = blobs.object->intersect(from, direction, t, kInfinity)) {
            t = hit->t + 1e-12;
            length += glm::dot(hit->normal, direction) > 0.0 ? hit->t : -hit->t;
            crossings += 1.0;
        }
        // Uniform lines: A = crossings S / 2; V = mean chord S / 4.
        const double shell = 4.0 * kPi * radius * radius;
        const std::array<double, 2> estimate{crossings * shell / 2.0, length * shell / 4.0};
        for (std::size_t k = 0; k < 2; ++k) {
            sum[k] += estimate[k];
            squares[k] += estimate[k] * estimate[k];
        }
    }
    const std::array<double, 2> expected{area, volume};
    for (std::size_t k = 0; k < 2; ++k) {
        const double mean = sum[k] / kLines;
        const double error = std::sqrt((squares[k] / kLines - mean * mean) / kLines);
        EXPECT_NEAR(mean, expected[k], 4.0 * error);
        EXPECT_LT(error, .01 * mean);
    }
}

// A face that leaves its object, which knows no nearest points: the rest stays as it is, and says so.
TEST(ProjectedBounds, whatCannotBeProjectedStaysPlanarAndIsCounted) {
    surface::Cage cage;
    cage.vertices = {{0, 0, .7}, {3, 0, .7}, {0, 3, .7}};
    cage.faces = {{0, 1, 2, 2}};
    const surface::ProjectedSurface surface(std::make_shared<test::BareSphere>(Vec3d(0.0), .7), cage);
    EXPECT_GT(surface.projectionCount().unsnapped, 30u);
    EXPECT_LT(surface.projectionCount().unsnapped, surface.projectionCount().points);
    const SurfacePoint p = surface.evaluate(0, Vec2d(1.0 / 3.0));
    EXPECT_LT(glm::distance(p.position, Vec3d(1.0, 1.0, .7)), 1e-12);
    EXPECT_NEAR(p.jacobian, 9.0, 1e-12);
    EXPECT_NEAR(p.normal.z, 1.0, 1e-12);
    base::RandomStream random(8);
    const surface::RegionBounds bounds = surface.bounds(0, wholeOf(surface, 0));
    for (int i = 0; i < 200; ++i) {
        const Vec3d x = surface.evaluate(0, inRegion(wholeOf(surface, 0), random)).position;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.box.lower, x)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(x, bounds.box.upper)));
    }
    EXPECT_GE(bounds.normals.halfAngle, kPi);
}

// A cage whose face reaches past the silhouette: rays along its field miss, the nearest point is still within
// reach.
TEST(ProjectedBounds, nearestPointsStandInWhereRaysMiss) {
    const auto object = std::make_shared<surface::SmoothUnion>(
        std::vector<surface::Ball>{{{0, 0, 0}, 1.0}, {{3.0, 0, 0}, 1.0}});
    surface::Cage cage;
    const double c = std::cos(.35 * kPi);
    const double s = std::sin(.35 * kPi);
    cage.vertices = {{0, 0, 1}, {c, 0, s}, {3 - c, 0, s}, {3, 0, 1}, {c, -.5, .9}, {3 - c, -.5, .9}};
    cage.faces = {{1, 4, 5, 2}};
    const surface::ProjectedSurface surface(object, cage);
    EXPECT_GT(surface.projectionCount().closest, 0u);
    // Their area measure is that of the map.
    base::RandomStream random(7);
    int tested = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec2d uv = Vec2d(.02) + .96 * random.next2();
        const SurfacePoint p = surface.evaluate(0, uv);
        ASSERT_TRUE(std::isfinite(p.jacobian));
        if (std::abs(object->value(p.position)) < 1e-10) {
            ++tested;
            EXPECT_LT(glm::distance(p.position, object->closestPoint(p.position)->position), 1e-9);
        }
    }
    EXPECT_GT(tested, 50);
}

}  // namespace fluxwalk
