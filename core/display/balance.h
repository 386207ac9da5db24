#pragma once

#include <vector>

#include "core/display/cell.h"

namespace fluxwalk::display {

/// Numbers the cells' corners and middles in `points` and quarters cells until no edge carries more than one
/// vertex between its ends, over the borders of patches too. Cells come in, none of them cut, and go out
/// ordered by patch and, within it, depth-first.
void balance(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells);

}  // namespace fluxwalk::display
