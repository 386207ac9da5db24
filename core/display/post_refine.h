#pragma once

#include <span>
#include <vector>

#include "core/display/cell.h"
#include "core/display/sample_net.h"

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

/// Samples of a cell, as CellVertices has its vertices; in the middle where it is shown as a fan.
struct CellSamples {
    std::array<std::uint32_t, 4> corners{};
    std::array<std::uint32_t, 4> middles{kNone, kNone, kNone, kNone};
    std::uint32_t center = kNone;
};

/// Balanced cells, as balance() leaves them, with what is known of the surface at their vertices.
struct RefinedCells {
    std::vector<Cell> cells;  ///< without points
    std::vector<CellSamples> cellSamples;
    std::span<const SurfaceSample> samples;
    std::uint32_t pointCount = 0;
};

/// What refining works in, to be used again: fresh memory costs more than what is done in it. Made for
/// 10^5 cells it holds about 60 MB.
struct RefineBuffers {
    SampleNet net;
    std::vector<Cell> cells;
    std::vector<CellNet> nets;
    std::vector<std::uint8_t> isCompact;
    std::vector<std::uint32_t> stack;
    RefinedCells refined;
};

/// Cells and vertices of a balanced mesh. What comes out, in `buffers`, is ordered as the cells are, its
/// `source` is the index of the cell that holds it. The middles of quads that were cut are points. Empty if
/// no cell needs to be cut.
const RefinedCells& refineForDisplay(const PatchTopology& topology, std::span<const Cell> cells,
                                     const MeshVertices& vertices, const RefineOptions& options,
                                     RefineBuffers& buffers);

}  // namespace fluxwalk::display
