#pragma once

#include <span>

#include "core/display/vertex_values.h"

namespace fluxwalk::display {

/// A mesh with its values, to take values from; its cells are not cut.
struct ValuedMesh {
    std::span<const Cell> cells;
    const MeshVertices& vertices;
    const MeshValues& values;
};

/// Irradiance at the vertices of `fine`, whose cells' sources are cells of `coarse`: what `coarse` shows
/// there, linear between its vertices.
MeshValues carryValues(const ValuedMesh& coarse, std::span<const Cell> cells, const MeshVertices& fine);

}  // namespace fluxwalk::display
