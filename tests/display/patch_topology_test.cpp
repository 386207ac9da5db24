#include "core/display/patch_topology.h"

#include <gtest/gtest.h>

#include "core/surface/subdivision_surface.h"
#include "tests/display/display_scenes.h"
#include "tests/display/mesh_checks.h"
#include "tests/surface/cages.h"

namespace fluxwalk::display {
namespace {

/// A square of one metre beside two of half a metre, turned and moved so that middles are rounded.
std::shared_ptr<const surface::PolygonMesh> makeSteppedFloor() {
    const std::array<Vec2d, 8> flat{
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0.5}, {1.5, 0}, {1.5, 0.5}, {1.5, 1}}};
    surface::TriangleSoup soup;
    for (const Vec2d& p : flat) {
        const double x = 0.8371 * p.x - 0.5471 * p.y + 17.3;
        const double z = 0.5471 * p.x + 0.8371 * p.y - 3.7;
        soup.positions.emplace_back(x, 1.234, z);
    }
    const std::array<std::array<std::uint32_t, 4>, 3> quads{{{0, 3, 2, 1}, {1, 4, 6, 5}, {4, 2, 7, 6}}};
    for (const auto& q : quads) {
        soup.triangles.push_back({q[0], q[1], q[2]});
        soup.triangles.push_back({q[0], q[2], q[3]});
    }
    return std::make_shared<surface::PolygonMesh>(std::move(soup));
}

TEST(PatchTopology, NeighboursNameSharedPointsAlike) {
    const auto floor = makeFloor(2, 2.0f);
    const PatchTopology topology(*floor);
    // Every grid point of every patch on a coarse lattice: same key where and only where same position.
    std::map<PositionKey, std::pair<std::uint64_t, std::uint32_t>> named;
    std::set<std::pair<std::uint64_t, std::uint32_t>> keys;
    for (std::uint32_t patch = 0; patch < floor->patchCount(); ++patch) {
        for (std::uint32_t i = 0; i <= 8; ++i) {
            for (std::uint32_t j = 0; j <= 8; ++j) {
                const GridPoint p{i * (kGridSize / 8), j * (kGridSize / 8)};
                const Vec3d position = floor->evaluate(patch, {i / 8.0, j / 8.0}).position;
                const PointKey key = topology.keyOf(patch, p);
                const auto [it, isNew] =
                    named.try_emplace(keyOf(Vec3(position)), std::pair(key.place, key.where));
                EXPECT_EQ(it->second, std::pair(key.place, key.where));
                keys.insert({key.place, key.where});
            }
        }
    }
    EXPECT_EQ(named.size(), 17u * 17u);
    EXPECT_EQ(keys.size(), named.size());
}

TEST(PatchTopology, CornersInTheMiddleOfFreeEdgesCutThem) {
    const auto floor = makeSteppedFloor();
    ASSERT_EQ(floor->patchCount(), 3u);
    const PatchTopology topology(*floor);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const auto leaves = makeLeaves(
            *floor, [](const Vec3d& p) { return p.x; }, SplitRandomly{seed, 5, 0.6}, 1);
        const auto meshes = buildDisplayMeshes(topology, 0, 0, leaves, MeshOptions{});
        const EdgeReport report = checkEdges(*meshes.meshes[0]);
        EXPECT_EQ(report.overused, 0u);
        EXPECT_EQ(report.eulerCharacteristic(), 1) << "seed " << seed;
        EXPECT_NEAR(totalArea(*meshes.meshes[0]), 1.5 * (0.8371 * 0.8371 + 0.5471 * 0.5471), 1e-4);
    }
}

// A subdivision surface with faces of three, four and five corners: quads lie along two sub-faces of others.
TEST(PatchTopology, CurvedEdgesAreCutWhereTheirMiddleIsACorner) {
    const surface::SubdivisionSurface body(test::mixedCage());
    const PatchTopology topology(body);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const auto leaves = makeLeaves(
            body, [](const Vec3d& p) { return p.x; }, SplitRandomly{seed, 4, 0.6}, 1);
        const auto meshes = buildDisplayMeshes(topology, 0, 0, leaves, MeshOptions{});
        const EdgeReport report = checkEdges(*meshes.meshes[0]);
        EXPECT_EQ(report.overused, 0u);
        EXPECT_TRUE(report.open.empty()) << "seed " << seed;
        EXPECT_EQ(report.eulerCharacteristic(), 2) << "seed " << seed;
    }
}

TEST(PatchTopology, CurvedEdgesWithTheSameEndsStayApart) {
    // All eight octants of a sphere: 6 corners, 12 edges, each shared by two patches.
    const surface::Sphere sphere(Vec3d(0.0), 1.0);
    const PatchTopology topology(sphere);
    std::set<std::pair<std::uint64_t, std::uint32_t>> corners;
    std::map<std::pair<std::uint64_t, std::uint32_t>, int> middles;
    for (std::uint32_t patch = 0; patch < 8; ++patch) {
        const std::array<GridPoint, 3> c{{{0, 0}, {kGridSize, 0}, {0, kGridSize}}};
        for (unsigned i = 0; i < 3; ++i) {
            const PointKey corner = topology.keyOf(patch, c[i]);
            const PointKey middle = topology.keyOf(patch, middleOf(c[i], c[(i + 1) % 3]));
            corners.insert({corner.place, corner.where});
            ++middles[{middle.place, middle.where}];
            EXPECT_FALSE(PatchTopology::isInside(middle));
        }
    }
    EXPECT_EQ(corners.size(), 6u);
    EXPECT_EQ(middles.size(), 12u);
    for (const auto& [key, count] : middles) {
        EXPECT_EQ(count, 2);
    }
}

}  // namespace
}  // namespace fluxwalk::display
