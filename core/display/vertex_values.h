#pragma once

#include <span>
#include <vector>

#include "core/display/leaf.h"
#include "core/display/mesh_vertices.h"

namespace fluxwalk::display {

/// Irradiance at the vertices of a mesh, lux.
struct MeshValues {
    std::vector<Rgb> values;   ///< of each value of MeshVertices
    std::vector<Rgb> centers;  ///< in the middle of each quad cell, parallel to the cells
};

/// Smooth vertex irradiance from the means of the solution's leaves (numbered by Cell::source).
///
/// Each leaf gets a gradient: the least-squares plane through the centroids of the leaves that it shares a
/// vertex value with. A vertex takes the mean of what its leaves extrapolate to, so that linear functions are
/// reproduced on leaves of any sizes and at borders, and the linear interpolant keeps the leaves' means of
/// quadratic functions on regular meshes. Values stay within the range of their leaves and those leaves'
/// neighbours plus a margin, and are never negative. A constant is reproduced exactly.
/// Leaves count by their exposed part: hidden ones do not darken the foot of the solid that hides them.
MeshValues reconstructValues(std::span<const Cell> cells, const MeshVertices& mesh,
                             std::span<const Leaf> leaves);

}  // namespace fluxwalk::display
