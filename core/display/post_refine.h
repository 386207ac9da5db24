#pragma once

#include <span>
#include <vector>

#include "core/display/cell.h"

/// Refinement for the eye, after the solution and without new transport (Schaefer, section 1, curvature-based
/// post-refinement).
namespace fluxwalk::display {

struct RefineOptions {
    /// Curved cells are cut until their normals lie within this angle of a common axis and no edge on their
    /// patch's border turns by more than twice that (radians), at most kMaxExtraLevels times each way.
    double curvatureAngle = 0.0698;
    /// Where no other patch follows, an edge may rise so far over its chord (metres): other objects may meet
    /// it, and must not leave a gap that is seen.
    double rimRise = 2e-4;
    /// Quads that are longer than wide are cut across until no triangle about their middle has a smaller
    /// angle (radians), except at a pole; 0 for never. Those of planar patches into kMaxPlanarStrips at most.
    double leastAngle = 0.2705;
    /// Once there are so many cells for each patch of the object, none is cut for its shape: thin wires would
    /// take hundreds of thousands.
    std::size_t mostCellsAPatch = 1u << 10;
};
inline constexpr unsigned kMaxExtraLevels = 7;
inline constexpr unsigned kMaxPlanarStrips = 4;

/// Cells of a mesh with their points: balanced, as balance() leaves them.
struct RefinedCells {
    std::vector<Cell> cells;
    PointTable points;
};

/// What comes out is ordered as the cells are, its `source` is the index of the cell that holds it. The
/// middles of quads that were cut are points. Cells need no numbers. Empty if no cell needs to be cut.
RefinedCells refineForDisplay(const PatchTopology& topology, std::span<const Cell> cells,
                              const RefineOptions& options);

}  // namespace fluxwalk::display
