#include "core/display/balance.h"

#include "core/display/cell_tree.h"

namespace fluxwalk::display {

void balance(const PatchTopology& topology, PointTable& points, std::vector<Cell>& cells) {
    CellTree tree(topology, points, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        tree.number(i);
    }
    // A split may unbalance cells that were looked at before: pass over all until nothing happens.
    bool changed = true;
    while (changed) {
        changed = false;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells[i].childCount == 0 && tree.isCrowded(i)) {
                const std::size_t first = cells.size();
                tree.split(i);
                for (std::size_t child = first; child < cells.size(); ++child) {
                    tree.number(child);
                }
                changed = true;
            }
        }
    }
    tree.keepLeaves();
}

}  // namespace fluxwalk::display
