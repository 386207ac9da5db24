#include "core/display/cell_tree.h"

namespace fluxwalk::display {

using Corners = std::array<GridPoint, 4>;

void CellTree::number(std::size_t index) {
    Cell& cell = cells_[index];
    const Corners corners = cornersOf(cell);
    for (unsigned i = 0; i < cell.cornerCount; ++i) {
        cell.points[i] = points_.insert(topology_.keyOf(cell.patch, corners[i]));
    }
}

// A vertex anywhere inside half an edge implies one at its middle: ancestors' corners are vertices.
bool CellTree::isCrowded(std::size_t index) {
    Cell& cell = cells_[index];
    const Corners corners = cornersOf(cell);
    for (unsigned i = 0; i < cell.cornerCount; ++i) {
        const GridPoint& a = corners[i];
        const GridPoint& b = corners[i + 1u == cell.cornerCount ? 0 : i + 1];
        const GridPoint middle = middleOf(a, b);
        cell.middles[i] = find(cell, middle);
        if (cell.middles[i] != kNone && canBeHalved(cell, i % 2 == 0 ? Axis::x : Axis::y) &&
            (find(cell, middleOf(a, middle)) != kNone || find(cell, middleOf(middle, b)) != kNone)) {
            return true;
        }
    }
    return false;
}

void CellTree::split(std::size_t index) {
    const Cell parent = cells_[index];
    const surface::Split split =
        surface::splitAt(topology_.strips(parent.patch), surface::pathLevel(parent.path));
    cells_[index].firstChild = static_cast<std::uint32_t>(cells_.size());
    cells_[index].childCount = 4;
    for (unsigned k = 0; k < 4; ++k) {
        cells_.push_back(partOf(parent, split, k));
    }
}

void CellTree::keepLeaves() {
    if (cells_.size() == rootCount_) {
        return;
    }
    std::vector<Cell> leaves;
    leaves.reserve(cells_.size());
    std::vector<std::uint32_t> stack;
    for (std::size_t root = 0; root < rootCount_; ++root) {
        stack.push_back(static_cast<std::uint32_t>(root));
        while (!stack.empty()) {
            const Cell& cell = cells_[stack.back()];
            stack.pop_back();
            if (cell.childCount == 0) {
                leaves.push_back(cell);
                continue;
            }
            for (std::uint32_t k = cell.childCount; k-- > 0;) {
                stack.push_back(cell.firstChild + k);
            }
        }
    }
    cells_ = std::move(leaves);
}

}  // namespace fluxwalk::display
