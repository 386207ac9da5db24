#include "core/display/mesh_parts.h"

#include "core/base/check.h"

namespace fluxwalk::display {

namespace {

using surface::kMaxLevel;
using surface::Path;

// First of the deepest elements that a path holds: they are numbered depth-first.
constexpr Path firstDeepest(Path path) {
    return path << (2 * (kMaxLevel - surface::pathLevel(path)));
}

}  // namespace

bool comesBefore(const Leaf& a, const Leaf& b) {
    if (a.back != b.back) {
        return b.back;
    }
    if (a.patch != b.patch) {
        return a.patch < b.patch;
    }
    return firstDeepest(a.path) < firstDeepest(b.path);
}

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

void shrink(scene::LitMesh& mesh) {
    mesh.positions.shrink_to_fit();
    mesh.normals.shrink_to_fit();
    mesh.irradiance.shrink_to_fit();
    mesh.triangles.shrink_to_fit();
    for (std::vector<base::Vec2>& set : mesh.texcoords) {
        set.shrink_to_fit();
    }
}

}  // namespace fluxwalk::display
