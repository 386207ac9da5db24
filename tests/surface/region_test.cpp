#include "core/surface/region.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/surface/cylinder.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"

namespace fluxwalk {

namespace {

using base::Vec2d;
using surface::Path;
using surface::PolygonMesh;
using surface::Region;
using surface::Sphere;

PolygonMesh skewQuad() {
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {3, 0, 0}, {2, 1.5f, 0}, {.5f, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    return PolygonMesh(std::move(soup));
}

// One patch, 1 m wide along v.
PolygonMesh rectangle(float length) {
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {length, 0, 0}, {length, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    return PolygonMesh(std::move(soup));
}

// Length of a rectangular region over its width, or the other way round, whichever is more than 1.
double longerBySquare(const PolygonMesh& mesh, const Region& region) {
    const auto at = [&](std::size_t i) { return mesh.evaluate(0, region.corners[i]).position; };
    const double a = glm::distance(at(0), at(1));
    const double b = glm::distance(at(1), at(2));
    return std::max(a, b) / std::min(a, b);
}

double cross(const Vec2d& a, const Vec2d& b) {
    return a.x * b.y - a.y * b.x;
}

double parameterArea(const Region& r) {
    double doubled = 0.0;
    for (std::uint32_t i = 0; i < r.cornerCount; ++i) {
        doubled += cross(r.corners[i], r.corners[(i + 1) % r.cornerCount]);
    }
    return .5 * doubled;
}

}  // namespace

TEST(Path, namesAndSteps) {
    Path path = surface::kRootPath;
    EXPECT_EQ(surface::pathLevel(path), 0u);
    for (const unsigned child : {2u, 0u, 3u, 1u}) {
        path = surface::childPath(path, child);
    }
    EXPECT_EQ(surface::pathLevel(path), 4u);
    EXPECT_EQ(surface::pathStep(path, 0), 2u);
    EXPECT_EQ(surface::pathStep(path, 1), 0u);
    EXPECT_EQ(surface::pathStep(path, 2), 3u);
    EXPECT_EQ(surface::pathStep(path, 3), 1u);
    EXPECT_EQ(surface::parentPath(surface::parentPath(path)),
              surface::childPath(surface::childPath(1, 2), 0));
    Path deepest = surface::kRootPath;
    for (unsigned i = 0; i < surface::kMaxLevel; ++i) {
        deepest = surface::childPath(deepest, 3);
    }
    EXPECT_EQ(surface::pathLevel(deepest), surface::kMaxLevel);
}

TEST(Region, childrenTileTheirParent) {
    const PolygonMesh quad = skewQuad();
    const Sphere sphere(base::Vec3d(0.0), 1.0);
    for (const surface::Surface* surface :
         {static_cast<const surface::Surface*>(&quad), static_cast<const surface::Surface*>(&sphere)}) {
        const Region whole = surface::wholePatch(surface->domain(0));
        EXPECT_GT(parameterArea(whole), 0.0);
        for (const Path path : {Path{1}, Path{0b1'01}, Path{0b1'11'10}, Path{0b1'10'00'11}}) {
            const Region parent = surface::regionOf(*surface, 0, path);
            double area = 0.0;
            double parameters = 0.0;
            for (unsigned child = 0; child < 4; ++child) {
                const Region r = surface::childRegion(*surface, 0, parent, surface::Split::quarters, child);
                EXPECT_EQ(r.cornerCount, parent.cornerCount);
                EXPECT_GT(parameterArea(r), 0.0) << "orientation is kept";
                area += surface->area(0, r);
                parameters += parameterArea(r);
                const Region named = surface::regionOf(*surface, 0, surface::childPath(path, child));
                for (std::uint32_t i = 0; i < r.cornerCount; ++i) {
                    EXPECT_EQ(named.corners[i], r.corners[i]);
                }
                if (child < r.cornerCount) {
                    EXPECT_EQ(r.corners[child], parent.corners[child]) << "child k keeps corner k";
                }
            }
            EXPECT_NEAR(area, surface->area(0, parent), 1e-12);
            EXPECT_NEAR(parameters, parameterArea(parent), 1e-12);
        }
    }
}

TEST(Region, mapIsAreaTrueAndStaysInside) {
    const Sphere sphere(base::Vec3d(0.0), 1.0);
    const PolygonMesh quad = skewQuad();
    base::RandomStream random(1);
    for (const Region& region :
         {surface::regionOf(sphere, 3, 0b1'11'01), surface::regionOf(quad, 0, 0b1'10)}) {
        double measure = 0.0;
        constexpr int kN = 50;
        for (int i = 0; i < kN; ++i) {
            for (int j = 0; j < kN; ++j) {
                const surface::RegionPoint p = surface::mapToRegion(region, {(i + .5) / kN, (j + .5) / kN});
                measure += p.jacobian / (kN * kN);
                for (std::uint32_t e = 0; e < region.cornerCount; ++e) {
                    const Vec2d& a = region.corners[e];
                    const Vec2d& b = region.corners[(e + 1) % region.cornerCount];
                    ASSERT_GE(cross(b - a, p.uv - a), -1e-15);
                }
            }
        }
        EXPECT_NEAR(measure, parameterArea(region), 1e-12);
    }
}

TEST(Region, childAtFindsTheQuarter) {
    const Sphere sphere(base::Vec3d(0.0), 1.0);
    const PolygonMesh quad = skewQuad();
    base::RandomStream random(2);
    for (const surface::Surface* surface :
         {static_cast<const surface::Surface*>(&quad), static_cast<const surface::Surface*>(&sphere)}) {
        for (const Path path : {Path{1}, Path{0b1'11}, Path{0b1'01'10}}) {
            const Region parent = surface::regionOf(*surface, 0, path);
            for (unsigned child = 0; child < 4; ++child) {
                const Region r = surface::childRegion(*surface, 0, parent, surface::Split::quarters, child);
                for (int i = 0; i < 20; ++i) {
                    const Vec2d inside = .01 + .98 * random.next2();
                    EXPECT_EQ(surface::childAt(*surface, 0, parent, surface::Split::quarters,
                                               surface::mapToRegion(r, inside).uv),
                              child);
                }
            }
        }
    }
}

// From a tenth to ten times as long as wide, and beyond: elements of some level are near to squares, and
// those of all levels below too.
TEST(Strips, longQuadsAreCutAcrossFirst) {
    for (const float length : {.001f, .05f, .3f, .5f, 1.0f, 2.0f, 2.7f, 3.0f, 9.0f, 12.0f, 700.0f, 1e4f}) {
        const PolygonMesh quad = rectangle(length);
        const surface::Strips strips = quad.strips(0);
        const bool isLong = length > 2.8f || length < .35f;
        EXPECT_EQ(strips.levels > 0, isLong) << length;
        const auto at = [&](const Vec2d& uv) { return quad.evaluate(0, uv).position; };
        const bool isLongAlongU =
            glm::distance(at({0, 0}), at({1, 0})) > glm::distance(at({0, 0}), at({0, 1}));
        Path path = surface::kRootPath;
        for (unsigned level = 0; level < strips.levels + 2u; ++level) {
            const surface::Split split = surface::splitAt(quad, 0, level);
            EXPECT_EQ(split, level >= strips.levels ? surface::Split::quarters
                             : isLongAlongU         ? surface::Split::stripsAlongU
                                                    : surface::Split::stripsAlongV);
            path = surface::childPath(path, level % 4);
        }
        const double ratio = longerBySquare(quad, surface::regionOf(quad, 0, path));
        EXPECT_LE(ratio, 2.81) << length;
        EXPECT_LE(surface::deepestLevel(quad, 0) + strips.levels, surface::kMaxLevel);
    }
}

TEST(Strips, tileTheirParentAtPointsOfQuarters) {
    const PolygonMesh quad = rectangle(12.0f);
    const Region whole = surface::wholePatch(quad.domain(0));
    base::RandomStream random(3);
    for (const surface::Split split : {surface::Split::stripsAlongU, surface::Split::stripsAlongV}) {
        const std::array<Region, 4> parts = surface::childRegions(quad, 0, whole, split);
        double area = 0.0;
        for (unsigned k = 0; k < 4; ++k) {
            EXPECT_GT(parameterArea(parts[k]), 0.0) << "orientation is kept";
            area += parameterArea(parts[k]);
            for (const Vec2d& corner : parts[k].corners) {
                EXPECT_EQ(corner * 4.0, glm::floor(corner * 4.0));
            }
            for (int i = 0; i < 20; ++i) {
                const Vec2d inside = .01 + .98 * random.next2();
                EXPECT_EQ(surface::childAt(quad, 0, whole, split, surface::mapToRegion(parts[k], inside).uv),
                          k);
            }
        }
        EXPECT_NEAR(area, parameterArea(whole), 1e-15);
    }
}

// A column of 0.15 m and 3 m: its quarters are 13 times as high as wide. Rings by their two radii.
TEST(Strips, curvedPatchesToo) {
    const surface::Cylinder column(base::Mat4d(1.0), .15, 3.0);
    EXPECT_EQ(column.strips(0).levels, 2u);
    EXPECT_TRUE(column.strips(3).alongV);
    EXPECT_EQ(surface::splitAt(column, 0, 0), surface::Split::quarters) << "it turns by 90 degrees";
    EXPECT_EQ(surface::splitAt(column, 0, 1), surface::Split::stripsAlongV);
    EXPECT_EQ(surface::splitAt(column, 0, 2), surface::Split::stripsAlongV);
    EXPECT_EQ(surface::splitAt(column, 0, 3), surface::Split::quarters);
    const surface::Torus ring(base::Mat4d(1.0), .2, .04);
    EXPECT_EQ(ring.strips(0).levels, 1u);
    EXPECT_FALSE(ring.strips(7).alongV);
    EXPECT_EQ(surface::Torus(base::Mat4d(1.0), .7, .3).strips(0).levels, 0u);
    EXPECT_EQ(Sphere(base::Vec3d(0.0), 1.0).strips(0).levels, 0u);
}

}  // namespace fluxwalk
