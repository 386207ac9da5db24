#pragma once

#include <vector>

#include "core/display/cell.h"

namespace fluxwalk::display {

/// Cells that are split until none has more than one vertex between the ends of an edge. Children follow
/// later in the vector than their parents.
class CellTree {
  public:
    /// Takes the cells as roots and keeps references to all. Points are numbered by number().
    CellTree(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells)
        : topology_(topology), points_(points), cells_(cells), rootCount_(cells.size()) {}

    void number(std::size_t index);

    /// Whether a side of a leaf has more than one vertex between its ends and can be split there; otherwise
    /// sets its middles. A leaf has its final middles when a whole pass finds no such side.
    bool isCrowded(std::size_t index);

    /// In four, as elements are. Children are not numbered.
    void split(std::size_t index);

    /// Leaves only, depth-first.
    void keepLeaves();

  private:
    std::uint32_t find(const Cell& cell, const GridPoint& p) const {
        return points_.find(topology_.keyOf(cell.patch, p));
    }

    const PatchTopology& topology_;
    PointTable& points_;
    std::vector<Cell>& cells_;
    std::size_t rootCount_;
};

}  // namespace fluxwalk::display
