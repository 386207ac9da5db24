#pragma once

#include <array>
#include <vector>

#include "core/display/cell.h"

namespace fluxwalk::display {

/// A point as a patch sees it.
struct Vertex {
    std::uint32_t point = 0;
    std::uint32_t next = kNone;  ///< the same point as another patch sees it
    std::uint32_t patch = 0;
    std::uint32_t value =
        kNone;  ///< index of its irradiance: shared with vertices that are not across a crease
    Vec2d uv{};
    Vec3 normal{};  ///< of the front
};

/// A cell's vertices; `middles[i]` hangs between corners i and i + 1, kNone where nothing does.
struct CellVertices {
    std::array<std::uint32_t, 4> corners{kNone, kNone, kNone, kNone};
    std::array<std::uint32_t, 4> middles{kNone, kNone, kNone, kNone};
    /// A quad shown as triangles about its middle. Others are small parts of curved leaves, on whose edges
    /// nothing hangs: two triangles show the same.
    bool isFan = false;
};

/// Whether a cell is shown as a fan, if something hangs on its edges or not.
bool isFan(const Cell& cell, bool isPlanar, bool hasMiddles);

struct CenterPoint {
    Vec3d position{};
    Vec3d normal{};
};

struct MeshVertices {
    std::vector<Vertex> vertices;
    std::vector<Vec3d> positions;      ///< of points
    std::vector<std::uint32_t> heads;  ///< of points: first vertex
    std::vector<CellVertices> cells;   ///< parallel to the cells
    std::vector<Vec2d> centers;        ///< (u,v) of the fans' middles, parallel to the cells
    /// The surface at the fans' middles, parallel to the cells, where it was known already; else empty.
    std::vector<CenterPoint> centerPoints;
    std::vector<std::uint32_t> pointOfValue;
};

/// Evaluates the surface at the corners of balanced cells. A point has one position, whichever patches share
/// it. Vertices of a point share a value where a chain of normals leads from one to the other whose steps are
/// at most `creaseAngle` (radians).
MeshVertices collectVertices(const PatchTopology& topology, const PointTable& points,
                             const std::vector<Cell>& cells, double creaseAngle);

struct RefinedCells;

/// The same for cells whose points were evaluated when they were made, in the memory that `out` has.
void collectVertices(const PatchTopology& topology, const RefinedCells& refined, double creaseAngle,
                     MeshVertices& out);

}  // namespace fluxwalk::display
