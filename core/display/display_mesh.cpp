#include "core/display/display_mesh.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/display/balance.h"
#include "core/display/carry_values.h"
#include "core/display/post_refine.h"
#include "core/display/triangulate.h"

namespace fluxwalk::display {

namespace {

using surface::kMaxLevel;
using surface::Path;

// First of the deepest elements that a path holds: they are numbered depth-first.
constexpr Path firstDeepest(Path path) {
    return path << (2 * (kMaxLevel - surface::pathLevel(path)));
}

bool comesBefore(const Leaf& a, const Leaf& b) {
    if (a.back != b.back) {
        return b.back;
    }
    if (a.patch != b.patch) {
        return a.patch < b.patch;
    }
    return firstDeepest(a.path) < firstDeepest(b.path);
}

// The leaves of each patch must follow each other without gap or overlap.
void checkTiling(std::span<const Leaf> leaves) {
    constexpr Path kEnd = firstDeepest(surface::kRootPath) << 1;
    Path expected = kEnd;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (i == 0 || leaves[i].patch != leaves[i - 1].patch) {
            FLUXWALK_CHECK_EQ(expected, kEnd);
            expected = firstDeepest(surface::kRootPath);
        }
        FLUXWALK_CHECK_EQ(firstDeepest(leaves[i].path), expected);
        expected += Path{1} << (2 * (kMaxLevel - surface::pathLevel(leaves[i].path)));
    }
    FLUXWALK_CHECK_EQ(expected, kEnd);
}

CellTable makeTable(std::span<const Cell> cells, std::uint32_t patchCount,
                    std::vector<std::uint32_t> firstTriangle) {
    CellTable table;
    table.firstTriangle = std::move(firstTriangle);
    table.firstCell.assign(patchCount + 1, 0);
    table.places.reserve(cells.size());
    for (const Cell& cell : cells) {
        ++table.firstCell[cell.patch + 1];
        table.places.push_back({cell.path, cell.cuts});
    }
    for (std::uint32_t patch = 0; patch < patchCount; ++patch) {
        table.firstCell[patch + 1] += table.firstCell[patch];
    }
    return table;
}

void buildSide(const PatchTopology& topology, std::span<const Leaf> leaves, const MeshOptions& options,
               scene::LitMesh& mesh, DisplayMeshes& out) {
    checkTiling(leaves);
    std::vector<Cell> cells;
    cells.reserve(leaves.size() + leaves.size() / 4);
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        cells.push_back(makeCell(topology, leaves[i].patch, leaves[i].path, i));
    }
    PointTable points(leaves.size() + leaves.size() / 4);
    balance(topology, points, cells);
    MeshVertices vertices = collectVertices(topology, points, cells, options.creaseAngle);
    MeshValues values = reconstructValues(cells, vertices, leaves);
    RefinedCells refined = refineForDisplay(
        topology, cells,
        {options.curvatureAngle, options.rimRise, options.leastAngle, options.mostCellsForShape});
    if (!refined.cells.empty()) {
        MeshVertices fine = collectVertices(topology, refined.points, refined.cells, options.creaseAngle);
        values = carryValues({cells, vertices, values}, refined.cells, fine);
        vertices = std::move(fine);
        cells = std::move(refined.cells);
    }
    const std::array<bool, 2> texcoords{options.texcoords[0] && topology.hasTexcoords(0),
                                        options.texcoords[1] && topology.hasTexcoords(1)};
    std::vector<std::uint32_t> firstTriangle =
        triangulate(topology, cells, vertices, values, texcoords, mesh);
    out.tables.push_back(makeTable(cells, topology.surface().patchCount(), std::move(firstTriangle)));
}

// Meshes stay for long: room that was reserved for the worst case is given back.
void shrink(scene::LitMesh& mesh) {
    mesh.positions.shrink_to_fit();
    mesh.normals.shrink_to_fit();
    mesh.irradiance.shrink_to_fit();
    mesh.triangles.shrink_to_fit();
    for (std::vector<base::Vec2>& set : mesh.texcoords) {
        set.shrink_to_fit();
    }
}

}  // namespace

DisplayMeshes buildDisplayMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                 std::span<const Leaf> leaves, const MeshOptions& options) {
    std::vector<Leaf> sorted;
    if (!std::is_sorted(leaves.begin(), leaves.end(), comesBefore)) {
        sorted.assign(leaves.begin(), leaves.end());
        std::sort(sorted.begin(), sorted.end(), comesBefore);
        leaves = sorted;
    }
    const auto firstBack =
        std::partition_point(leaves.begin(), leaves.end(), [](const Leaf& leaf) { return !leaf.back; });
    const auto frontCount = static_cast<std::size_t>(firstBack - leaves.begin());
    DisplayMeshes out;
    for (const bool back : {false, true}) {
        const auto side = back ? leaves.subspan(frontCount) : leaves.first(frontCount);
        if (side.empty()) {
            continue;
        }
        const auto mesh = std::make_shared<scene::LitMesh>();
        mesh->object = object;
        mesh->material = material;
        mesh->back = back;
        buildSide(topology, side, options, *mesh, out);
        shrink(*mesh);
        out.meshes.push_back(mesh);
    }
    return out;
}

}  // namespace fluxwalk::display
