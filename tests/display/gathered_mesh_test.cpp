#include "core/display/gathered_mesh.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "core/display/interpolate.h"
#include "tests/display/display_scenes.h"
#include "tests/display/mesh_checks.h"

namespace fluxwalk::display {
namespace {

/// What is known of a point: nothing where it is hidden.
using Found = std::function<std::optional<double>(const Vec3d&)>;

/// Light at all points that a leaf and its cells down to `depth` have; cells are cut where `isCut` says.
LeafLight sampleLeaf(const PatchTopology& topology, const Leaf& leaf, const Found& found,
                     const std::function<bool(surface::Path)>& isCut, unsigned depth) {
    LeafLight light;
    const surface::Surface& surface = topology.surface();
    const auto add = [&](const GridPoint& at, const Vec2d& uv) {
        const auto e = found(surface.evaluate(leaf.patch, uv).position);
        light.samples.push_back({at, Rgb(static_cast<float>(e.value_or(0.0))), !e});
    };
    const std::function<void(const Cell&, unsigned)> visit = [&](const Cell& cell, unsigned level) {
        const auto region = surface::regionOf(surface, leaf.patch, cell.path);
        const auto corners = cornersOf(cell);
        for (unsigned k = 0; k < cell.cornerCount; ++k) {
            add(corners[k], region.corners[k]);
            if (cell.cornerCount == 3) {
                add(middleOf(corners[k], corners[(k + 1) % 3]),
                    0.5 * (region.corners[k] + region.corners[(k + 1) % 3]));
            }
        }
        if (cell.cornerCount == 4) {
            add(middleOf(corners[0], corners[2]), 0.5 * (region.corners[0] + region.corners[2]));
        }
        if (level < depth && isCut(cell.path)) {
            light.splits.push_back(cell.path);
            const surface::Split split =
                surface::splitAt(topology.strips(leaf.patch), surface::pathLevel(cell.path));
            for (unsigned k = 0; k < 4; ++k) {
                visit(partOf(cell, split, k), level + 1);
            }
        }
    };
    visit(makeCell(topology, leaf.patch, leaf.path, 0), 0);
    std::sort(light.splits.begin(), light.splits.end());
    std::sort(light.samples.begin(), light.samples.end(), [](const LightSample& a, const LightSample& b) {
        return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x;
    });
    return light;
}

struct Lit {
    std::vector<Leaf> leaves;
    std::vector<LeafLight> found;
    std::vector<const LeafLight*> lights;
};

Lit light(const PatchTopology& topology, std::vector<Leaf> leaves, const Found& found, std::uint64_t seed,
          unsigned depth) {
    Lit lit{std::move(leaves), {}, {}};
    for (const Leaf& leaf : lit.leaves) {
        lit.found.push_back(sampleLeaf(
            topology, leaf, found,
            [&](surface::Path path) {
                return base::toUnit(base::mix(base::combine(base::combine(seed, leaf.patch), path))) < 0.4;
            },
            depth));
    }
    for (const LeafLight& one : lit.found) {
        lit.lights.push_back(&one);
    }
    return lit;
}

double slope(const Vec3d& p) {
    return 3.0 + 0.3 * p.x + 0.2 * p.y - 0.4 * p.z;
}

TEST(GatheredMesh, ClosesAndShowsLinearLightExactly) {
    const auto box = makeBox({1, 2, 3});
    const auto floor = makeTriangleFloor(2.0f);
    for (const auto& surface : {box, floor}) {
        const PatchTopology topology(*surface);
        const Lit lit =
            light(topology, makeLeaves(*surface, slope, SplitRandomly{5, 3, 0.5}, 1), slope, 7, 3);
        const DisplayMeshes meshes =
            buildGatheredMeshes(topology, 0, 0, lit.leaves, lit.lights, MeshOptions{});
        ASSERT_EQ(meshes.meshes.size(), 1u);
        const scene::LitMesh& mesh = *meshes.meshes[0];
        const EdgeReport report = checkEdges(mesh);
        EXPECT_EQ(report.overused, 0u);
        EXPECT_EQ(report.degenerate, 0u);
        if (surface == box) {
            EXPECT_TRUE(report.open.empty());
            EXPECT_EQ(report.eulerCharacteristic(), 2);
        }
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            ASSERT_NEAR(static_cast<double>(mesh.irradiance[v].r), slope(Vec3d(mesh.positions[v])), 1e-5)
                << (surface == box) << " " << mesh.positions[v].x << " " << mesh.positions[v].y << " "
                << mesh.positions[v].z;
        }
    }
}

TEST(GatheredMesh, IsCutWhereTheLightAsksForIt) {
    const auto floor = makeFloor(1, 2.0f);
    const PatchTopology topology(*floor);
    const std::vector<Leaf> leaves = makeLeaves(*floor, slope, SplitUniformly{1}, 1);
    const LeafLight fine = sampleLeaf(
        topology, leaves[0], slope, [](surface::Path) { return true; }, 3);
    const std::vector<const LeafLight*> lights{&fine, nullptr, nullptr, nullptr};
    const DisplayMeshes meshes = buildGatheredMeshes(topology, 0, 0, leaves, lights, MeshOptions{});
    const CellTable& table = meshes.tables[0];
    const auto count = [&](unsigned level) {
        return std::count_if(table.places.begin(), table.places.end(), [level](const CellPlace& place) {
            return surface::pathLevel(place.path) == level;
        });
    };
    EXPECT_EQ(count(4), 64);
    // Balance alone cuts the others, to half as fine beside it and less beyond.
    EXPECT_EQ(count(3), 16);
    EXPECT_GT(count(2), 0);
    EXPECT_EQ(count(5), 0);
    EXPECT_EQ(checkEdges(*meshes.meshes[0]).overused, 0u);
}

TEST(GatheredMesh, WithoutAnyLightIsTheInterpolatedMesh) {
    const auto box = makeBox({1, 2, 3});
    const PatchTopology topology(*box);
    const std::vector<Leaf> leaves = makeLeaves(*box, slope, SplitRandomly{3, 4, 0.5}, 4);
    const std::vector<const LeafLight*> none(leaves.size(), nullptr);
    const DisplayMeshes gathered = buildGatheredMeshes(topology, 0, 0, leaves, none, MeshOptions{});
    const DisplayMeshes plain = buildDisplayMeshes(topology, 0, 0, leaves, MeshOptions{});
    EXPECT_EQ(gathered.meshes[0]->triangles, plain.meshes[0]->triangles);
    EXPECT_EQ(gathered.meshes[0]->positions, plain.meshes[0]->positions);
    ASSERT_EQ(gathered.meshes[0]->irradiance.size(), plain.meshes[0]->irradiance.size());
    for (std::size_t v = 0; v < plain.meshes[0]->irradiance.size(); ++v) {
        EXPECT_NEAR(gathered.meshes[0]->irradiance[v].r, plain.meshes[0]->irradiance[v].r, 1e-5f);
    }
}

TEST(GatheredMesh, DoesNotDependOnTheOrderOfLeaves) {
    const auto box = makeBox({1, 2, 3});
    const PatchTopology topology(*box);
    Lit lit = light(topology, makeLeaves(*box, slope, SplitRandomly{3, 4, 0.5}, 1), slope, 11, 2);
    const DisplayMeshes first = buildGatheredMeshes(topology, 0, 0, lit.leaves, lit.lights, MeshOptions{});
    std::reverse(lit.leaves.begin(), lit.leaves.end());
    std::reverse(lit.lights.begin(), lit.lights.end());
    const DisplayMeshes second = buildGatheredMeshes(topology, 0, 0, lit.leaves, lit.lights, MeshOptions{});
    EXPECT_EQ(first.meshes[0]->irradiance, second.meshes[0]->irradiance);
    EXPECT_EQ(first.meshes[0]->triangles, second.meshes[0]->triangles);
}

// A solid stands on the floor beyond x = 0.9: nothing is known there, and it must neither darken nor brighten
// what is seen before it.
TEST(GatheredMesh, TakesLightOverIntoWhatIsHidden) {
    const auto floor = makeFloor(1, 2.0f);
    const PatchTopology topology(*floor);
    const Found found = [](const Vec3d& p) { return p.x < 0.9 ? std::optional(5.0 + p.z) : std::nullopt; };
    // What the solution has there is far too dark.
    const Irradiance dark = [](const Vec3d& p) { return p.x < 0.9 ? 5.0 + p.z : 0.0; };
    const Lit lit = light(topology, makeLeaves(*floor, dark, SplitUniformly{3}, 4), found, 1, 0);
    const DisplayMeshes meshes = buildGatheredMeshes(topology, 0, 0, lit.leaves, lit.lights, MeshOptions{});
    const DisplayLookup lookup(*floor, meshes);
    double worst = 0.0;
    for (double u = 0.01; u < 0.45; u += 0.02) {
        for (double v = 0.01; v < 1.0; v += 0.02) {
            const Vec3d p = floor->evaluate(0, {u, v}).position;
            if (p.x < 0.9) {
                const double shown = static_cast<double>(lookup.irradiance(0, false, {u, v})->r);
                worst = std::max(worst, std::abs(shown - (5.0 + p.z)));
            }
        }
    }
    // Half a cell along z.
    EXPECT_LT(worst, 0.13);
}

// Leaves that found the same but for an error of their own, as rays leave one: no edges are seen between.
TEST(GatheredMesh, SpreadsWhatLeavesDifferBy) {
    const auto floor = makeFloor(1, 2.0f);
    const PatchTopology topology(*floor);
    const std::vector<Leaf> leaves = makeLeaves(*floor, slope, SplitUniformly{1}, 1);
    std::vector<LeafLight> found;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const double off = i % 2 == 0 ? 0.1 : -0.1;
        found.push_back(sampleLeaf(
            topology, leaves[i], [off](const Vec3d&) { return std::optional(10.0 + off); },
            [](surface::Path) { return true; }, 3));
    }
    std::vector<const LeafLight*> lights;
    for (const LeafLight& one : found) {
        lights.push_back(&one);
    }
    const DisplayMeshes meshes = buildGatheredMeshes(topology, 0, 0, leaves, lights, MeshOptions{});
    const DisplayLookup lookup(*floor, meshes);
    double steepest = 0.0;
    constexpr double kStep = 1.0 / 64.0;
    for (double t = 0.01; t + kStep < 1.0; t += kStep) {
        for (const double across : {0.2, 0.5, 0.77}) {
            for (const bool alongU : {false, true}) {
                const auto at = [&](double along) {
                    const Vec2d uv = alongU ? Vec2d(along, across) : Vec2d(across, along);
                    return static_cast<double>(lookup.irradiance(0, false, uv)->r);
                };
                steepest = std::max(steepest, std::abs(at(t + kStep) - at(t)));
            }
        }
    }
    // The difference of 0.2 over a half of the floor at least, not at a line.
    EXPECT_LT(steepest, 0.2 * 2.0 * kStep * 1.05);
}

}  // namespace
}  // namespace fluxwalk::display
