#include "core/surface/polygon_mesh.h"

#include <bit>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/surface/region.h"

namespace fluxwalk {

namespace {

using base::Vec2d;
using base::Vec3;
using base::Vec3d;
using surface::PatchDomain;
using surface::PolygonMesh;
using surface::Region;
using surface::TriangleSoup;

// Heights on an n x n grid of unit squares; each square is two triangles along alternating diagonals.
TriangleSoup grid(unsigned n, float (*height)(unsigned, unsigned)) {
    TriangleSoup soup;
    for (unsigned j = 0; j <= n; ++j) {
        for (unsigned i = 0; i <= n; ++i) {
            soup.positions.emplace_back(static_cast<float>(i), height(i, j), -static_cast<float>(j));
        }
    }
    for (unsigned j = 0; j < n; ++j) {
        for (unsigned i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            const std::uint32_t b = a + 1;
            const std::uint32_t c = b + n + 1;
            const std::uint32_t d = a + n + 1;
            if ((i + j) % 2 == 0) {
                soup.triangles.push_back({a, b, c});
                soup.triangles.push_back({a, c, d});
            } else {
                soup.triangles.push_back({a, b, d});
                soup.triangles.push_back({b, c, d});
            }
        }
    }
    return soup;
}

float flat(unsigned, unsigned) {
    return 0.0f;
}
float bumpy(unsigned i, unsigned j) {
    return .3f * static_cast<float>((i * 7 + j * 13) % 5);
}

double wholeArea(const PolygonMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t p = 0; p < mesh.patchCount(); ++p) {
        sum += mesh.area(p, surface::wholePatch(mesh.domain(p)));
    }
    return sum;
}

// A convex quad without parallel edges.
PolygonMesh trapezium() {
    TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {3, 0, 0}, {2, 1.5f, 0}, {.5f, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    return PolygonMesh(std::move(soup));
}

}  // namespace

TEST(PolygonMesh, coplanarTrianglesBecomeSquares) {
    const PolygonMesh mesh(grid(6, flat));
    EXPECT_EQ(mesh.patchCount(), 36u);
    EXPECT_NEAR(wholeArea(mesh), 36.0, 1e-12);
    for (std::uint32_t p = 0; p < mesh.patchCount(); ++p) {
        EXPECT_EQ(mesh.domain(p), PatchDomain::quad);
        EXPECT_NEAR(mesh.area(p, surface::wholePatch(PatchDomain::quad)), 1.0, 1e-12);
        EXPECT_NEAR(mesh.evaluate(p, {.3, .6}).normal.y, 1.0, 1e-12);
    }
}

TEST(PolygonMesh, bentTrianglesStayTriangles) {
    const PolygonMesh mesh(grid(6, bumpy));
    std::uint32_t quads = 0;
    for (std::uint32_t p = 0; p < mesh.patchCount(); ++p) {
        quads += mesh.domain(p) == PatchDomain::quad ? 1u : 0u;
        const auto c = mesh.corners(p);
        const Vec3d n = mesh.evaluate(p, {.2, .2}).normal;
        for (const Vec3d& corner : c) {
            EXPECT_NEAR(glm::dot(n, corner - c[0]), 0.0, 1e-5);
        }
    }
    EXPECT_EQ(mesh.patchCount() + quads, 72u);
    EXPECT_LT(quads, 10u);
}

TEST(PolygonMesh, pairsOnlyOneAffineTextureMapAndOneSide) {
    TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(PolygonMesh(soup).patchCount(), 1u) << "corners are welded by position";
    TriangleSoup mapped = soup;
    mapped.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    const PolygonMesh affine(mapped);
    ASSERT_EQ(affine.patchCount(), 1u);
    base::RandomStream random(1);
    for (int i = 0; i < 20; ++i) {
        const Vec2d uv = random.next2();
        const Vec3d p = affine.evaluate(0, uv).position;
        EXPECT_LT(glm::distance(affine.texcoord(0, uv, 0), Vec2d(p.x, p.y)), 1e-12);
    }
    mapped.texcoords[0][5] = {.5f, 1.5f};
    EXPECT_EQ(PolygonMesh(mapped).patchCount(), 2u) << "not affine";
    mapped.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {.5f, 0}, {1, 1}, {0, 1}};
    EXPECT_EQ(PolygonMesh(mapped).patchCount(), 2u) << "a seam";
    TriangleSoup turned = soup;
    turned.triangles[1] = {4, 3, 5};
    EXPECT_EQ(PolygonMesh(turned).patchCount(), 2u) << "fronts on opposite sides";
    TriangleSoup concave;
    concave.positions = {{0, 0, 0}, {1, 0, 0}, {.2f, .2f, 0}, {0, 1, 0}};
    concave.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(PolygonMesh(concave).patchCount(), 2u) << "an arrow is not convex";
}

TEST(PolygonMesh, edgesOfThreeTrianglesAreNotPaired) {
    TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {.5f, 1, 0}, {.5f, -1, 0}, {.5f, 0, 1}};
    soup.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    EXPECT_EQ(PolygonMesh(soup).patchCount(), 3u);
}

TEST(PolygonMesh, trianglesWithoutAreaAreDroppedAndCounted) {
    TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    soup.triangles = {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}};
    const PolygonMesh mesh(soup);
    EXPECT_EQ(mesh.patchCount(), 1u);
    EXPECT_EQ(mesh.droppedTriangleCount(), 2u);
    EXPECT_EQ(mesh.triangles().triangles.size(), 1u);
}

TEST(PolygonMesh, locateInvertsEvaluateOnEveryShape) {
    const PolygonMesh quads(grid(2, flat));
    const PolygonMesh bent(grid(3, bumpy));
    const PolygonMesh skew = trapezium();
    ASSERT_EQ(skew.patchCount(), 1u);
    base::RandomStream random(2);
    for (const PolygonMesh* mesh : {&quads, &bent, &skew}) {
        for (int i = 0; i < 300; ++i) {
            const auto patch = static_cast<std::uint32_t>(static_cast<unsigned>(i) % mesh->patchCount());
            const Region whole = surface::wholePatch(mesh->domain(patch));
            const Vec2d uv = surface::mapToRegion(whole, random.next2()).uv;
            const surface::SurfacePoint p = mesh->evaluate(patch, uv);
            EXPECT_LT(glm::distance(mesh->locate(patch, p.position), uv), 1e-12);
            EXPECT_LT(glm::distance(mesh->locate(patch, p.position + 1e-4 * p.normal), uv), 1e-7)
                << "points off the plane are projected";
        }
        // Outside: clamped into the domain.
        const Vec2d far = mesh->locate(0, {100, 0, -100});
        EXPECT_GE(std::min(far.x, far.y), 0.0);
        EXPECT_LE(std::max(far.x, far.y), 1.0);
    }
}

TEST(PolygonMesh, jacobianIsTheAreaMeasure) {
    const PolygonMesh mesh = trapezium();
    constexpr int kN = 64;
    double sum = 0.0;
    for (int i = 0; i < kN; ++i) {
        for (int j = 0; j < kN; ++j) {
            sum += mesh.evaluate(0, {(i + .5) / kN, (j + .5) / kN}).jacobian / (kN * kN);
        }
    }
    EXPECT_NEAR(sum, mesh.area(0, surface::wholePatch(PatchDomain::quad)), 1e-10);
    // Shoelace: (0,0) (3,0) (2,1.5) (.5,1).
    EXPECT_NEAR(sum, .5 * (3.0 * 1.5 + (2.0 * 1.0 - .5 * 1.5)), 1e-10);
}

// Neighbours that share two corners give bitwise equal points at dyadic parameters of their common edge.
TEST(PolygonMesh, neighboursShareTheirEdgesBitwise) {
    TriangleSoup soup = grid(5, bumpy);
    for (Vec3& p : soup.positions) {
        p = p * 1.37f + Vec3(.1f, .2f, .3f);
    }
    const PolygonMesh mesh(std::move(soup));
    using Bits = std::array<std::uint64_t, 3>;
    const auto bits = [](const Vec3d& p) { return std::bit_cast<Bits>(std::array{p.x, p.y, p.z}); };
    // Every edge, by its ends' bits: points at 1/8 steps as seen from each patch that has it.
    std::map<std::pair<Bits, Bits>, std::vector<std::vector<Bits>>> edges;
    for (std::uint32_t patch = 0; patch < mesh.patchCount(); ++patch) {
        const Region whole = surface::wholePatch(mesh.domain(patch));
        for (std::uint32_t e = 0; e < whole.cornerCount; ++e) {
            Vec2d a = whole.corners[e];
            Vec2d b = whole.corners[(e + 1) % whole.cornerCount];
            if (bits(mesh.evaluate(patch, b).position) < bits(mesh.evaluate(patch, a).position)) {
                std::swap(a, b);
            }
            std::vector<Bits> points;
            for (int i = 0; i <= 8; ++i) {
                points.push_back(bits(mesh.evaluate(patch, a + (i / 8.0) * (b - a)).position));
            }
            const std::pair ends{points.front(), points.back()};
            edges[ends].push_back(std::move(points));
        }
    }
    std::size_t shared = 0;
    for (const auto& [ends, seen] : edges) {
        ASSERT_LE(seen.size(), 2u);
        if (seen.size() == 2) {
            ++shared;
            EXPECT_EQ(seen[0], seen[1]);
        }
    }
    EXPECT_GT(shared, 30u);
}

TEST(PolygonMesh, boundsAndRays) {
    const PolygonMesh mesh(grid(4, bumpy));
    base::RandomStream random(3);
    for (std::uint32_t patch = 0; patch < mesh.patchCount(); ++patch) {
        const Region whole = surface::wholePatch(mesh.domain(patch));
        const surface::RegionBounds bounds = mesh.bounds(patch, whole);
        EXPECT_EQ(bounds.normals.halfAngle, 0.0);
        for (int i = 0; i < 5; ++i) {
            const surface::SurfacePoint p =
                mesh.evaluate(patch, surface::mapToRegion(whole, random.next2()).uv);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(p.position[axis], bounds.box.lower[axis] - 1e-12);
                EXPECT_LE(p.position[axis], bounds.box.upper[axis] + 1e-12);
            }
            EXPECT_LT(glm::distance(p.normal, bounds.normals.axis), 1e-12);
            const auto hit = mesh.intersect(p.position + Vec3d(0, 5, 0), {0, -1, 0}, 0.0, 100.0);
            ASSERT_TRUE(hit.has_value());
            EXPECT_NEAR(hit->t, 5.0, 1e-6);
            EXPECT_LT(glm::distance(mesh.evaluate(hit->patch, hit->uv).position, p.position), 1e-6);
        }
    }
    EXPECT_FALSE(mesh.intersect({.5, 9, -.5}, {0, 1, 0}, 0.0, 100.0).has_value());
}

}  // namespace fluxwalk
