#pragma once

#include <span>
#include <vector>

#include "core/display/vertex_values.h"

/// Refinement of curved surfaces for the eye, after the solution and without new transport (Schaefer, section
/// 1, curvature-based post-refinement).
namespace fluxwalk::display {

/// Quarters cells until their normals lie within `angle` (radians) of a common axis and no edge turns by more
/// than twice that, at most kMaxExtraLevels times. What comes out is ordered as the cells are, not balanced,
/// its points are not numbered and its `source` is the index of the cell that holds it. Empty if no cell
/// needs it.
std::vector<Cell> refineByCurvature(const PatchTopology& topology, std::span<const Cell> cells, double angle);
inline constexpr unsigned kMaxExtraLevels = 7;

/// A mesh with its values, to take values from.
struct ValuedMesh {
    std::span<const Cell> cells;
    const MeshVertices& vertices;
    const MeshValues& values;
};

/// Irradiance at the vertices of `fine`, whose cells' sources are cells of `coarse`: what `coarse` shows
/// there, linear between its vertices.
MeshValues carryValues(const ValuedMesh& coarse, std::span<const Cell> cells, const MeshVertices& fine);

}  // namespace fluxwalk::display
