#include "core/display/display_mesh.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/display/display_scenes.h"
#include "tests/display/mesh_checks.h"

namespace fluxwalk::display {
namespace {

double slope(const Vec3d& p) {
    return 3.0 + 0.5 * p.x - 0.2 * p.y + 0.1 * p.z;
}

DisplayMeshes build(const surface::Surface& surface, const std::vector<Leaf>& leaves,
                    const MeshOptions& options = {}) {
    return buildDisplayMeshes(PatchTopology(surface), 7, 5, leaves, options);
}

bool isOnFloorBorder(const base::Vec3& p, float size) {
    return p.x == 0.0f || p.z == 0.0f || p.x == size || p.z == size;
}

void expectClosedFloor(const scene::LitMesh& mesh, float size) {
    const EdgeReport report = checkEdges(mesh);
    EXPECT_EQ(report.overused, 0u);
    EXPECT_EQ(report.degenerate, 0u);
    EXPECT_EQ(report.eulerCharacteristic(), 1);
    for (const auto& [a, b] : report.open) {
        EXPECT_TRUE(isOnFloorBorder(a, size) && isOnFloorBorder(b, size))
            << "open edge at " << a.x << ' ' << a.z << " - " << b.x << ' ' << b.z;
        EXPECT_TRUE(a.x == b.x || a.z == b.z);
    }
    EXPECT_NEAR(totalArea(mesh), static_cast<double>(size * size), 1e-5 * static_cast<double>(size * size));
}

TEST(DisplayMesh, FloorsOfRandomQuadtreesHaveNoTVertices) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const auto floor = makeFloor(3, 3.0f);
        const auto meshes = build(*floor, makeLeaves(*floor, slope, SplitRandomly{seed}, 1));
        ASSERT_EQ(meshes.meshes.size(), 1u);
        expectClosedFloor(*meshes.meshes[0], 3.0f);
    }
}

TEST(DisplayMesh, FloorsOfTrianglePatchesHaveNoTVertices) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const auto floor = makeTriangleFloor(4.0f);
        const auto meshes = build(*floor, makeLeaves(*floor, slope, SplitRandomly{seed}, 1));
        expectClosedFloor(*meshes.meshes[0], 4.0f);
    }
}

TEST(DisplayMesh, BoxIsWatertight) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const auto box = makeBox({1.0f, 2.0f, 3.0f});
        ASSERT_EQ(box->patchCount(), 6u);
        const auto meshes = build(*box, makeLeaves(*box, slope, SplitRandomly{seed}, 1));
        const EdgeReport report = checkEdges(*meshes.meshes[0]);
        EXPECT_TRUE(report.open.empty());
        EXPECT_EQ(report.overused, 0u);
        EXPECT_EQ(report.eulerCharacteristic(), 2);
        EXPECT_NEAR(totalArea(*meshes.meshes[0]), 22.0, 1e-4);
    }
}

TEST(DisplayMesh, SphereIsWatertight) {
    const surface::Sphere sphere(Vec3d(0.3, -0.2, 0.7), 1.7);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const auto meshes = build(sphere, makeLeaves(sphere, slope, SplitRandomly{seed, 6, 0.7}, 1));
        const EdgeReport report = checkEdges(*meshes.meshes[0]);
        EXPECT_TRUE(report.open.empty());
        EXPECT_EQ(report.overused, 0u);
        EXPECT_EQ(report.degenerate, 0u);
        EXPECT_EQ(report.eulerCharacteristic(), 2);
    }
}

TEST(DisplayMesh, SphereHasTheSurfacesNormalsAndArea) {
    const Vec3d center(0.3, -0.2, 0.7);
    const surface::Sphere sphere(center, 1.7);
    const auto meshes = build(sphere, makeLeaves(sphere, slope, SplitUniformly{5}, 1));
    const scene::LitMesh& mesh = *meshes.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3d expected = (Vec3d(mesh.positions[i]) - center) / 1.7;
        EXPECT_LT(glm::distance(Vec3d(mesh.normals[i]), expected), 1e-6);
    }
    EXPECT_NEAR(totalArea(mesh), 4.0 * base::kPi * 1.7 * 1.7, 0.003 * 4.0 * base::kPi * 1.7 * 1.7);
}

TEST(DisplayMesh, WindingsAndNormalsFaceTheirSide) {
    const auto box = makeBox({1.0f, 2.0f, 3.0f});
    std::vector<Leaf> leaves = makeLeaves(*box, slope, SplitRandomly{3}, 1);
    std::vector<Leaf> back = makeLeaves(*box, slope, SplitRandomly{4}, 1);
    for (Leaf& leaf : back) {
        leaf.back = true;
    }
    leaves.insert(leaves.begin(), back.begin(), back.end());
    const auto meshes = build(*box, leaves);
    ASSERT_EQ(meshes.meshes.size(), 2u);
    EXPECT_FALSE(meshes.meshes[0]->back);
    EXPECT_TRUE(meshes.meshes[1]->back);
    for (const auto& mesh : meshes.meshes) {
        EXPECT_EQ(mesh->object, 7u);
        EXPECT_EQ(mesh->material, 5u);
        EXPECT_EQ(mesh->normals.size(), mesh->positions.size());
        EXPECT_EQ(mesh->irradiance.size(), mesh->positions.size());
        EXPECT_TRUE(mesh->texcoords[0].empty());
        const Vec3d middle(0.5, 1.0, 1.5);
        for (std::size_t t = 0; t < mesh->triangles.size() / 3; ++t) {
            const Vec3d across = areaVector(*mesh, t);
            const Vec3d outwards = Vec3d(mesh->positions[mesh->triangles[3 * t]]) - middle;
            EXPECT_EQ(glm::dot(across, outwards) > 0.0, !mesh->back);
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3d normal(mesh->normals[mesh->triangles[3 * t + k]]);
                EXPECT_GT(glm::dot(glm::normalize(across), normal), 0.9999);
            }
        }
    }
}

TEST(DisplayMesh, TrianglesHaveNoSmallAngles) {
    const auto floor = makeFloor(2, 2.0f);
    const auto meshes = build(*floor, makeLeaves(*floor, slope, SplitRandomly{9}, 1));
    const scene::LitMesh& mesh = *meshes.meshes[0];
    for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](std::size_t i) {
                return Vec3d(mesh.positions[mesh.triangles[3 * t + i % 3]]);
            };
            const double cosine =
                glm::dot(glm::normalize(at(k + 1) - at(k)), glm::normalize(at(k + 2) - at(k)));
            EXPECT_LT(cosine, std::cos(base::kPi / 4.0) + 1e-3);
        }
    }
}

/// Squares of the balanced display leaves of a floor, in units of 2^-16 of its patches.
struct Square {
    std::uint32_t x = 0;
    std::uint32_t z = 0;
    std::uint32_t size = 0;
};

bool shareEdge(const Square& a, const Square& b) {
    const auto overlap = [](std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1) {
        return std::min(a1, b1) > std::max(a0, b0);
    };
    const bool besideX = a.x + a.size == b.x || b.x + b.size == a.x;
    const bool besideZ = a.z + a.size == b.z || b.z + b.size == a.z;
    return (besideX && overlap(a.z, a.z + a.size, b.z, b.z + b.size)) ||
           (besideZ && overlap(a.x, a.x + a.size, b.x, b.x + b.size));
}

TEST(DisplayMesh, NeighboursDifferByAtMostOneLevel) {
    const unsigned n = 3;
    const auto floor = makeFloor(n, 3.0f);
    const auto leaves = makeLeaves(*floor, slope, SplitRandomly{11, 7, 0.5}, 1);
    const auto meshes = build(*floor, leaves);
    const CellTable& table = meshes.tables[0];
    EXPECT_GT(table.places.size(), leaves.size());
    std::vector<Square> squares;
    for (std::uint32_t patch = 0; patch < floor->patchCount(); ++patch) {
        for (std::uint32_t c = table.firstCell[patch]; c < table.firstCell[patch + 1]; ++c) {
            const surface::Region region = surface::regionOf(*floor, patch, table.places[c].path);
            Vec3d low(1e9);
            Vec3d high(-1e9);
            for (const Vec2d& uv : region.corners) {
                const Vec3d p = floor->evaluate(patch, uv).position;
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            squares.push_back({static_cast<std::uint32_t>(std::lround(low.x * 65536.0)),
                               static_cast<std::uint32_t>(std::lround(low.z * 65536.0)),
                               static_cast<std::uint32_t>(std::lround((high.x - low.x) * 65536.0))});
        }
    }
    for (const Square& a : squares) {
        for (const Square& b : squares) {
            if (shareEdge(a, b)) {
                EXPECT_LE(a.size, 2 * b.size);
            }
        }
    }
}

TEST(DisplayMesh, LeavesThatAreBalancedStayAsTheyAre) {
    const auto floor = makeFloor(2, 2.0f);
    const auto leaves = makeLeaves(*floor, slope, SplitUniformly{3}, 1);
    const auto meshes = build(*floor, leaves);
    EXPECT_EQ(meshes.tables[0].places.size(), leaves.size());
    EXPECT_EQ(meshes.meshes[0]->triangles.size() / 3, 4 * leaves.size());
    // One vertex for each corner (coplanar patches share them) and one for each middle.
    EXPECT_EQ(meshes.meshes[0]->positions.size(), 17u * 17u + leaves.size());
}

TEST(DisplayMesh, DoesNotDependOnTheLeavesOrder) {
    const auto box = makeBox({1.0f, 2.0f, 3.0f});
    std::vector<Leaf> leaves = makeLeaves(*box, slope, SplitRandomly{5}, 1);
    const auto first = build(*box, leaves);
    base::RandomStream random(3);
    for (std::size_t i = leaves.size(); i > 1; --i) {
        std::swap(leaves[i - 1], leaves[static_cast<std::size_t>(random.next() * static_cast<double>(i))]);
    }
    const auto second = build(*box, leaves);
    EXPECT_EQ(first.meshes[0]->positions, second.meshes[0]->positions);
    EXPECT_EQ(first.meshes[0]->irradiance, second.meshes[0]->irradiance);
    EXPECT_EQ(first.meshes[0]->triangles, second.meshes[0]->triangles);
}

TEST(DisplayMesh, TextureCoordinatesFollowThePatchesAcrossSeams) {
    // Two squares side by side whose second set jumps at the common edge.
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    soup.texcoords[1] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 0}};
    const surface::PolygonMesh surface(soup);
    ASSERT_EQ(surface.patchCount(), 2u);
    const auto meshes = build(surface, makeLeaves(surface, slope, SplitRandomly{2}, 1));
    const scene::LitMesh& mesh = *meshes.meshes[0];
    EXPECT_TRUE(mesh.texcoords[0].empty());
    ASSERT_EQ(mesh.texcoords[1].size(), mesh.positions.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const float patch =
            std::floor((mesh.positions[mesh.triangles[t]].x + mesh.positions[mesh.triangles[t + 1]].x +
                        mesh.positions[mesh.triangles[t + 2]].x) /
                       3.0f);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = mesh.triangles[t + k];
            EXPECT_NEAR(mesh.texcoords[1][i].x, mesh.positions[i].x - patch, 1e-6f);
            EXPECT_NEAR(mesh.texcoords[1][i].y, mesh.positions[i].z, 1e-6f);
        }
    }
    MeshOptions none;
    none.texcoords = {true, false};
    EXPECT_TRUE(build(surface, makeLeaves(surface, slope, SplitUniformly{1}, 1), none)
                    .meshes[0]
                    ->texcoords[1]
                    .empty());
}

TEST(DisplayMesh, DeepestLeavesKeepTheirNames) {
    const auto floor = makeFloor(1, 1.0f);
    const auto towardsCorner = [](std::uint32_t, surface::Path path, const surface::Region&) {
        // Only first quarters are split.
        return surface::pathLevel(path) < surface::kMaxLevel && path == surface::Path{1}
                                                                            << (2 * surface::pathLevel(path));
    };
    const auto leaves = makeLeaves(
        *floor, [](const Vec3d&) { return 4.0; }, towardsCorner, 1);
    EXPECT_EQ(leaves.size(), 3u * surface::kMaxLevel + 1u);
    const auto meshes = build(*floor, leaves);
    EXPECT_EQ(meshes.tables[0].places.size(), leaves.size());
    EXPECT_NEAR(totalArea(*meshes.meshes[0]), 1.0, 1e-6);
    for (const Rgb& value : meshes.meshes[0]->irradiance) {
        EXPECT_EQ(value, Rgb(4.0f, 2.0f, 1.0f));
    }
}

TEST(DisplayMeshDeath, RefusesLeavesThatDoNotTile) {
    const auto floor = makeFloor(1, 1.0f);
    auto leaves = makeLeaves(*floor, slope, SplitUniformly{2}, 1);
    leaves.pop_back();
    EXPECT_DEATH(build(*floor, leaves), "check failed");
    leaves.push_back(leaves.front());
    EXPECT_DEATH(build(*floor, leaves), "check failed");
}

// Light that changes on leaves that stay: as if built anew, to the bit.
TEST(DisplayMesh, RevaluedMeshesAreThoseOfTheNewLight) {
    const auto floor = makeFloor(3, 4.0f);
    const auto triangles = makeTriangleFloor(4.0f);
    const auto box = makeBox({1, 2, 3});
    const surface::Sphere sphere(Vec3d(0.0), 1.0);
    for (const surface::Surface* surface :
         {static_cast<const surface::Surface*>(floor.get()),
          static_cast<const surface::Surface*>(triangles.get()),
          static_cast<const surface::Surface*>(box.get()), static_cast<const surface::Surface*>(&sphere)}) {
        const PatchTopology topology(*surface);
        std::vector<Leaf> leaves = makeLeaves(*surface, slope, SplitRandomly{4}, 1);
        const DisplayMeshes before = buildDisplayMeshes(topology, 3, 5, leaves, MeshOptions{});
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            leaves[i].irradiance *= static_cast<float>(0.1 + 0.37 * static_cast<double>(i % 7));
        }
        std::reverse(leaves.begin(), leaves.end());
        const DisplayMeshes revalued = revalueDisplayMeshes(before, leaves);
        const DisplayMeshes built = buildDisplayMeshes(topology, 3, 5, leaves, MeshOptions{});
        ASSERT_EQ(revalued.meshes.size(), built.meshes.size());
        for (std::size_t m = 0; m < built.meshes.size(); ++m) {
            EXPECT_EQ(revalued.meshes[m]->irradiance, built.meshes[m]->irradiance);
            EXPECT_NE(before.meshes[m]->irradiance, built.meshes[m]->irradiance);
            EXPECT_EQ(revalued.meshes[m]->positions, built.meshes[m]->positions);
            EXPECT_EQ(revalued.meshes[m]->triangles, built.meshes[m]->triangles);
            EXPECT_EQ(revalued.meshes[m]->object, 3u);
            EXPECT_EQ(revalued.meshes[m]->material, 5u);
        }
    }
}

}  // namespace
}  // namespace fluxwalk::display
