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

/// Where in a coarse mesh the values of a fine one come from: those of its vertices, then those in the middle
/// of its cells. Stays as long as both meshes do.
struct CarryPlan {
    struct Sample {
        std::uint32_t source = kNone;  ///< coarse cell; kNone where there is no value
        GridPoint at{};
    };
    std::vector<Sample> samples;
};

/// For the vertices of `fine`, whose cells' sources are cells of the coarse mesh.
CarryPlan planCarrying(std::span<const Cell> cells, const MeshVertices& fine);

/// Irradiance at the `valueCount` values of the fine mesh and its cells' middles: what `coarse` shows there,
/// linear between its vertices.
MeshValues carryValues(const ValuedMesh& coarse, const CarryPlan& plan, std::size_t valueCount);

}  // namespace fluxwalk::display
