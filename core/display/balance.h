#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/display/patch_topology.h"
#include "core/surface/region.h"

namespace fluxwalk::display {

/// A display leaf: a leaf of the solution, or a quarter that balancing made of one.
struct Cell {
    surface::Path path = surface::kRootPath;
    std::uint32_t patch = 0;
    std::uint32_t source = 0;  ///< the solution's leaf that holds it, as numbered by the caller
    GridPoint origin;          ///< corner 0
    std::array<std::uint32_t, 4> points{};
    /// Points in the middles of the edges between corners i and i + 1, kNone where there is none.
    std::array<std::uint32_t, 4> middles{kNone, kNone, kNone, kNone};
    std::uint32_t firstChild = 0;  ///< of four in a row, 0 for none; used while balancing
    std::uint8_t cornerCount = 4;
    bool inverted = false;  ///< triangle whose corners lie towards smaller coordinates
};

/// Corners in the patch's grid; the fourth of a triangle means nothing.
std::array<GridPoint, 4> cornersOf(const Cell& cell);

/// Cell of the leaf that `path` names; its points are not numbered yet.
Cell makeCell(const PatchTopology& topology, std::uint32_t patch, surface::Path path, std::uint32_t source);

/// Numbers the cells' corners and middles in `points` and quarters cells until no edge carries more than one
/// vertex between its ends, over the borders of patches too. Cells come in and go out ordered by patch and,
/// within it, depth-first.
void balance(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells);

}  // namespace fluxwalk::display
