#include <algorithm>

#include <gtest/gtest.h>

#include "core/display/cell_regions.h"
#include "core/display/interpolate.h"
#include "tests/display/display_scenes.h"
#include "tests/display/mesh_checks.h"
#include "tests/support/curved_scenes.h"
#include "tests/surface/curved_shapes.h"

// Post-refinement of curved surfaces for the eye: regular, closed, exact, and of the same light.

namespace fluxwalk::display {
namespace {

constexpr double kDegree = base::kPi / 180.0;

double slope(const Vec3d& p) {
    return 3.0 + 0.5 * p.x - 0.2 * p.y + 0.1 * p.z;
}

const auto kNever = [](std::uint32_t, surface::Path, const surface::Region&) { return false; };

DisplayMeshes build(const surface::Surface& surface, const std::vector<Leaf>& leaves, double angle) {
    MeshOptions options;
    options.curvatureAngle = angle;
    return buildDisplayMeshes(PatchTopology(surface), 0, 0, leaves, options);
}

// All shapes, and a column.
std::vector<test::CurvedShape> shapes() {
    std::vector<test::CurvedShape> all = test::curvedShapes();
    const auto column = [](const base::Mat4d& m, bool inside) -> test::SurfacePtr {
        return std::make_shared<const surface::Cylinder>(m, 0.16, 2.45, inside);
    };
    all.push_back({"column", column, 4});
    return all;
}

surface::Region regionOf(const surface::Surface& surface, std::uint32_t patch, const CellPlace& place) {
    surface::Region region = surface::regionOf(surface, patch, place.path);
    for (unsigned level = 0; level < surface::pathLevel(place.cuts); ++level) {
        const unsigned step = surface::pathStep(place.cuts, level);
        region = halfRegions(surface, patch, region, axisOfStep(step))[step & 1u];
    }
    return region;
}

// Of a sphere, of what has one border and of what has two or is a ring.
int eulerCharacteristicOf(const std::string& name) {
    if (name == "sphere") {
        return 2;
    }
    return name == "cone" || name == "coneUpsideDown" || name == "disk" ? 1 : 0;
}

// Cells at whose sides others are less than half as long.
std::size_t countUnevenCells(const PatchTopology& topology, const CellTable& table) {
    const auto nameOf = [](const PointKey& key) { return std::pair(key.place, key.where); };
    std::vector<Cell> cells;
    std::set<std::pair<std::uint64_t, std::uint32_t>> corners;
    for (std::uint32_t patch = 0; patch + 1 < table.firstCell.size(); ++patch) {
        for (std::uint32_t c = table.firstCell[patch]; c < table.firstCell[patch + 1]; ++c) {
            Cell cell = makeCell(topology, patch, table.places[c].path, c);
            for (unsigned level = 0; level < surface::pathLevel(table.places[c].cuts); ++level) {
                const unsigned step = surface::pathStep(table.places[c].cuts, level);
                cell = halfOf(cell, axisOfStep(step), step & 1u);
            }
            const auto at = cornersOf(cell);
            for (unsigned k = 0; k < cell.cornerCount; ++k) {
                corners.insert(nameOf(topology.keyOf(patch, at[k])));
            }
            cells.push_back(cell);
        }
    }
    std::size_t uneven = 0;
    for (const Cell& cell : cells) {
        const auto at = cornersOf(cell);
        bool isUneven = false;
        for (unsigned k = 0; k < cell.cornerCount; ++k) {
            const GridPoint& a = at[k];
            const GridPoint& b = at[(k + 1u) % cell.cornerCount];
            for (const GridPoint& end : {a, b}) {
                const GridPoint quarter = middleOf(end, middleOf(a, b));
                isUneven = isUneven || corners.contains(nameOf(topology.keyOf(cell.patch, quarter)));
            }
        }
        uneven += isUneven ? 1u : 0u;
    }
    return uneven;
}

class Curvature : public testing::TestWithParam<test::CurvedShape> {
  protected:
    test::SurfacePtr surface_ = GetParam().make(base::Mat4d(1.0), false);
};
INSTANTIATE_TEST_SUITE_P(Shapes, Curvature, testing::ValuesIn(shapes()),
                         [](const auto& shape) { return shape.param.name; });

// From the coarsest solution and from random ones, with normals as they are on the shape.
TEST_P(Curvature, closesAndKeepsToTheThreshold) {
    for (const double angle : {12.0 * kDegree, 4.0 * kDegree}) {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            const auto leaves = seed == 0 ? makeLeaves(*surface_, slope, kNever, 1)
                                          : makeLeaves(*surface_, slope, SplitRandomly{seed, 3}, 1);
            const DisplayMeshes built = build(*surface_, leaves, angle);
            ASSERT_EQ(built.meshes.size(), 1u);
            const EdgeReport report = checkEdges(*built.meshes[0]);
            EXPECT_EQ(report.overused, 0u) << "an edge belongs to two triangles at most";
            // A crack is a hole, which lowers it by one.
            EXPECT_EQ(report.eulerCharacteristic(), eulerCharacteristicOf(GetParam().name));
            const CellTable& table = built.tables[0];
            EXPECT_EQ(countUnevenCells(PatchTopology(*surface_), table), 0u);
            for (std::uint32_t patch = 0; patch < surface_->patchCount(); ++patch) {
                for (std::uint32_t c = table.firstCell[patch]; c < table.firstCell[patch + 1]; ++c) {
                    const surface::Region region = regionOf(*surface_, patch, table.places[c]);
                    EXPECT_LE(surface_->bounds(patch, region).normals.halfAngle, angle + 1e-12);
                }
            }
        }
    }
}

TEST_P(Curvature, carriesTheLightThatWasShown) {
    const auto leaves = makeLeaves(*surface_, slope, SplitRandomly{5, 2}, 2);
    MeshOptions asSolved;
    asSolved.curvatureAngle = base::kPi;
    asSolved.leastAngle = 0.0;
    asSolved.rimRise = std::numeric_limits<double>::infinity();
    const DisplayMeshes coarse = buildDisplayMeshes(PatchTopology(*surface_), 0, 0, leaves, asSolved);
    const DisplayMeshes fine = build(*surface_, leaves, 3.0 * kDegree);
    ASSERT_GT(fine.meshes[0]->triangles.size(), coarse.meshes[0]->triangles.size());
    // At the coarse mesh's vertices nothing changes.
    std::map<PositionKey, std::vector<Rgb>> shown;
    for (std::size_t v = 0; v < fine.meshes[0]->positions.size(); ++v) {
        shown[keyOf(fine.meshes[0]->positions[v])].push_back(fine.meshes[0]->irradiance[v]);
    }
    float lowest = std::numeric_limits<float>::infinity();
    float highest = 0.0f;
    for (std::size_t v = 0; v < coarse.meshes[0]->positions.size(); ++v) {
        const auto found = shown.find(keyOf(coarse.meshes[0]->positions[v]));
        ASSERT_NE(found, shown.end());
        const Rgb& value = coarse.meshes[0]->irradiance[v];
        EXPECT_TRUE(std::any_of(found->second.begin(), found->second.end(), [&](const Rgb& other) {
            return glm::all(glm::lessThan(glm::abs(other - value), Rgb(1e-5f)));
        }));
        lowest = std::min(lowest, value.g);
        highest = std::max(highest, value.g);
    }
    for (const Rgb& value : fine.meshes[0]->irradiance) {
        EXPECT_GE(value.g, lowest - 1e-5f);
        EXPECT_LE(value.g, highest + 1e-5f);
    }
}

// Everywhere, not only at vertices, and found in the cells that were cut. (Between leaves of very different
// sizes the light has kinks, which a mesh of few cells leaves out.)
TEST_P(Curvature, showsTheSameLightBetweenVertices) {
    const auto leaves = makeLeaves(*surface_, slope, SplitUniformly{3}, 2);
    MeshOptions options;
    options.mostCellsForShape = 1u << 12;
    const DisplayMeshes cut = buildDisplayMeshes(PatchTopology(*surface_), 0, 0, leaves, options);
    options.leastAngle = 0.0;
    const DisplayMeshes whole = buildDisplayMeshes(PatchTopology(*surface_), 0, 0, leaves, options);
    const DisplayLookup inCut(*surface_, cut);
    const DisplayLookup inWhole(*surface_, whole);
    float worst = 0.0f;
    base::RandomStream random(3);
    for (int i = 0; i < 1000; ++i) {
        const auto patch = static_cast<std::uint32_t>(random.next() * surface_->patchCount());
        const Vec2d uv =
            surface::mapToRegion(surface::wholePatch(surface_->domain(patch)), random.next2()).uv;
        const float expected = inWhole.irradiance(patch, false, uv)->r;
        worst = std::max(worst, std::abs(inCut.irradiance(patch, false, uv)->r / expected - 1.0f));
    }
    EXPECT_LT(worst, 0.005f);
}

TEST_P(Curvature, isTheSameInEveryRunAndRedoneFromTheSolution) {
    const auto leaves = makeLeaves(*surface_, slope, SplitRandomly{9, 2}, 2);
    const DisplayMeshes first = build(*surface_, leaves, 5.0 * kDegree);
    const DisplayMeshes again = build(*surface_, leaves, 5.0 * kDegree);
    EXPECT_EQ(first.meshes[0]->triangles, again.meshes[0]->triangles);
    EXPECT_EQ(first.meshes[0]->irradiance, again.meshes[0]->irradiance);
}

// Smallest angle of a triangle of the mesh, in degrees.
double smallestAngle(const scene::LitMesh& mesh, std::uint32_t triangle) {
    double smallest = 180.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto corner = [&](std::size_t n) {
            return Vec3d(mesh.positions[mesh.triangles[3 * std::size_t{triangle} + n % 3]]);
        };
        const Vec3d a = corner(k + 1) - corner(k);
        const Vec3d b = corner(k + 2) - corner(k);
        smallest = std::min(smallest, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDegree);
    }
    return smallest;
}

// Whether a region has an edge without length.
bool touchesPole(const surface::Surface& surface, std::uint32_t patch, const surface::Region& region) {
    for (unsigned k = 0; k < region.cornerCount; ++k) {
        const Vec3d a = surface.evaluate(patch, region.corners[k]).position;
        const Vec3d b = surface.evaluate(patch, region.corners[(k + 1) % region.cornerCount]).position;
        if (glm::distance(a, b) < 1e-9) {
            return true;
        }
    }
    return false;
}

// Wires stop at a number of cells by default; they too would become well shaped.
TEST_P(Curvature, trianglesAreWellShaped) {
    const bool isWire = GetParam().name == "needle" || GetParam().name == "thinTorus";
    for (const double angle : {10.0, 5.0}) {
        for (std::uint64_t seed = 0; seed < (angle > 9.0 ? 3u : 1u); ++seed) {
            const auto leaves = seed == 0 ? makeLeaves(*surface_, slope, kNever, 1)
                                          : makeLeaves(*surface_, slope, SplitRandomly{seed, 3}, 1);
            MeshOptions options;
            options.curvatureAngle = angle * kDegree;
            options.mostCellsForShape = isWire ? 1u << 20 : options.mostCellsForShape;
            const DisplayMeshes built = buildDisplayMeshes(PatchTopology(*surface_), 0, 0, leaves, options);
            const scene::LitMesh& mesh = *built.meshes[0];
            const CellTable& table = built.tables[0];
            double smallest = 180.0;
            std::size_t atPoles = 0;
            for (std::uint32_t patch = 0; patch < surface_->patchCount(); ++patch) {
                for (std::uint32_t c = table.firstCell[patch]; c < table.firstCell[patch + 1]; ++c) {
                    if (touchesPole(*surface_, patch, regionOf(*surface_, patch, table.places[c]))) {
                        ++atPoles;
                        continue;
                    }
                    for (std::uint32_t t = table.firstTriangle[c]; t < table.firstTriangle[c + 1]; ++t) {
                        smallest = std::min(smallest, smallestAngle(mesh, t));
                    }
                }
            }
            EXPECT_GE(smallest, 15.0) << angle << ' ' << seed;
            EXPECT_LT(atPoles, table.places.size() / 2);
            EXPECT_EQ(checkEdges(mesh).degenerate, 0u);
        }
    }
}

TEST(CurvatureShapes, aSphereIsClosedRoundAndSmooth) {
    const surface::Sphere sphere(Vec3d(1.0, 2.0, 3.0), 0.5);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const auto leaves = makeLeaves(sphere, slope, SplitRandomly{seed, 3}, 1);
        const DisplayMeshes built = build(sphere, leaves, 4.0 * kDegree);
        const scene::LitMesh& mesh = *built.meshes[0];
        const EdgeReport report = checkEdges(mesh);
        EXPECT_TRUE(report.open.empty());
        EXPECT_EQ(report.eulerCharacteristic(), 2);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const Vec3d out = Vec3d(mesh.positions[v]) - Vec3d(1.0, 2.0, 3.0);
            EXPECT_NEAR(glm::length(out), 0.5, 1e-6);
            EXPECT_GT(glm::dot(glm::normalize(out), Vec3d(mesh.normals[v])), 1.0 - 1e-6);
        }
        // A silhouette of chords that span at most twice the angle.
        const double sagitta = 0.5 * (1.0 - std::cos(4.0 * kDegree));
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3d a(mesh.positions[mesh.triangles[t + k]]);
                const Vec3d b(mesh.positions[mesh.triangles[t + (k + 1) % 3]]);
                EXPECT_GT(glm::length(0.5 * (a + b) - Vec3d(1.0, 2.0, 3.0)), 0.5 - sagitta - 1e-6);
            }
        }
    }
}

// Surfaces whose patches meet as they like, and whose edges are not split in the middle of their parameters.
TEST(CurvatureShapes, cagesAndProjectedSurfacesStayClosed) {
    for (const test::CurvedScene& made : test::roomsWithSolids()) {
        if (made.name != "vase" && made.name != "smoothUnion") {
            continue;
        }
        scene::Scene scene = test::glowingScene(made.name);
        made.fill(scene);
        const surface::Surface& surface = *scene.objects.back().surface;
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            const auto leaves = makeLeaves(surface, slope, SplitRandomly{seed, 2}, 1);
            const DisplayMeshes built = build(surface, leaves, 6.0 * kDegree);
            const scene::LitMesh& mesh = *built.meshes[0];
            const EdgeReport report = checkEdges(mesh);
            EXPECT_TRUE(report.open.empty()) << made.name;
            EXPECT_EQ(report.overused, 0u) << made.name;
            EXPECT_EQ(report.eulerCharacteristic(), 2) << made.name;
            double smallest = 180.0;
            std::size_t folded = 0;
            for (std::uint32_t t = 0; t < mesh.triangles.size() / 3; ++t) {
                smallest = std::min(smallest, smallestAngle(mesh, t));
                const Vec3d n = areaVector(mesh, t);
                folded +=
                    glm::dot(n, Vec3d(mesh.normals[mesh.triangles[3 * std::size_t{t}]])) <= 0.0 ? 1u : 0u;
            }
            EXPECT_EQ(folded, 0u) << made.name;
            EXPECT_GE(smallest, 15.0) << made.name;
        }
    }
}

// Rims of different objects on one circle, and what of them a picture could show between them.
TEST(CurvatureShapes, rimsThatMeetLeaveNoGap) {
    base::Mat4d up(1.0);
    up[3] = {0.0, 1.5, 0.0, 1.0};
    const surface::Cylinder wall(base::Mat4d(1.0), 4.5, 3.0, true);
    const surface::Disk ceiling(up, 4.5, 0.0, true);
    std::array<std::set<PositionKey>, 2> rims;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const surface::Surface& surface = seed == 1 ? static_cast<const surface::Surface&>(wall) : ceiling;
        const auto leaves = makeLeaves(surface, slope, SplitRandomly{seed, 4}, 1);
        const DisplayMeshes built = build(surface, leaves, 4.0 * kDegree);
        for (const auto& [a, b] : checkEdges(*built.meshes[0]).open) {
            const Vec3d middle = 0.5 * (Vec3d(a) + Vec3d(b));
            EXPECT_GT(std::hypot(middle.x, middle.z), 4.5 - 2.1e-4);
            if (a.y > 0.0f) {
                const auto rounded = [](float x) { return std::round(x * 1e4f) * 1e-4f; };
                rims[seed - 1].insert({rounded(a.x), rounded(a.y), rounded(a.z)});
            }
        }
    }
    EXPECT_EQ(rims[0], rims[1]);
}

// A board is cut into four at most, whatever its length.
TEST(CurvatureShapes, boardsAreCutAcross) {
    for (const float length : {1.2f, 8.0f, 200.0f}) {
        surface::TriangleSoup soup;
        soup.positions = {{0, 0, 0}, {length, 0, 0}, {length, 0, 1}, {0, 0, 1}};
        soup.triangles = {{0, 3, 2}, {0, 2, 1}};
        const surface::PolygonMesh board(std::move(soup));
        const DisplayMeshes built = build(board, makeLeaves(board, slope, kNever, 1), 4.0 * kDegree);
        const scene::LitMesh& mesh = *built.meshes[0];
        const std::size_t strips = length < 2.0f ? 1 : 4;
        EXPECT_EQ(built.tables[0].places.size(), strips);
        EXPECT_EQ(checkEdges(mesh).eulerCharacteristic(), 1);
        EXPECT_NEAR(totalArea(mesh) / static_cast<double>(length), 1.0, 1e-4);
        for (std::uint32_t t = 0; length < 10.0f && t < mesh.triangles.size() / 3; ++t) {
            EXPECT_GE(smallestAngle(mesh, t), 15.0);
        }
    }
}

// Thin wires stop at a number of cells.
TEST(CurvatureShapes, wiresDoNotTakeMillions) {
    const surface::Cylinder wire(base::Mat4d(1.0), 0.001, 10.0);
    const auto leaves = makeLeaves(wire, slope, kNever, 1);
    MeshOptions options;
    options.mostCellsForShape = 1024;
    const DisplayMeshes built = buildDisplayMeshes(PatchTopology(wire), 0, 0, leaves, options);
    EXPECT_EQ(built.tables[0].places.size(), 4096u);
    EXPECT_EQ(checkEdges(*built.meshes[0]).eulerCharacteristic(), 0);
}

TEST(CurvatureShapes, planesAreLeftAlone) {
    const auto floor = makeFloor(2, 2.0f);
    const auto leaves = makeLeaves(*floor, slope, SplitRandomly{3, 3}, 1);
    EXPECT_EQ(build(*floor, leaves, base::kPi).meshes[0]->triangles,
              build(*floor, leaves, kDegree).meshes[0]->triangles);
}

}  // namespace
}  // namespace fluxwalk::display
