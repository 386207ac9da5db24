#pragma once

#include <span>

#include "core/display/vertex_values.h"
#include "core/scene/lit_mesh.h"

namespace fluxwalk::display {

/// Writes the triangles of all cells, in their order, into `mesh` (whose `back` is set) and returns each
/// cell's first triangle, followed by the number of all.
///
/// Quads become fans about their middle, whose triangles are half squares with or without hanging vertices
/// and show no preferred diagonal; triangles are cut by templates into halves and quarters. Vertices are
/// shared where irradiance, normal and texture coordinates are equal. `valueOf` gets the index of each
/// vertex's value, where the cells' middles follow the values.
std::vector<std::uint32_t> triangulate(const PatchTopology& topology, std::span<const Cell> cells,
                                       const MeshVertices& vertices, const MeshValues& values,
                                       const std::array<bool, 2>& texcoords, scene::LitMesh& mesh,
                                       std::vector<std::uint32_t>& valueOf);

}  // namespace fluxwalk::display
