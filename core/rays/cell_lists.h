#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/rays/spatial_tree.h"

namespace fluxwalk::rays {

/// What lies in the cells of a tree's grids: each leaf in all cells that its box touches.
class CellLists {
  public:
    CellLists(const SpatialTree& tree, const base::Executor& executor);

    /// Calls visit(node) for the leaves in the cells along origin + t * direction with t in [tNear, tFar], in
    /// order of the cells, until it returns true; whether it did. The line must be finite.
    template <class Visit>
    bool walk(std::size_t grid, const base::Vec3d& origin, const base::Vec3d& direction, double tNear,
              double tFar, const Visit& visit) const {
        const Grid& g = grids_[grid];
        Walk at = g.enter(origin, direction, tNear, tFar);
        while (at.isInside) {
            for (std::uint32_t i = g.starts[at.cell]; i < g.starts[at.cell + 1]; ++i) {
                if (visit(g.leaves[i])) {
                    return true;
                }
            }
            at.step(g.cells);
        }
        return false;
    }

  private:
    /// Where a line is on its way through a grid.
    struct Walk {
        std::array<std::int64_t, 3> place{};
        std::array<std::int64_t, 3> direction{};
        base::Vec3d next{};      ///< t at which the line leaves the cell along each axis
        base::Vec3d distance{};  ///< t from cell to cell
        double end = 0.0;
        std::size_t cell = 0;
        bool isInside = false;

        void step(const std::array<std::uint32_t, 3>& cells) {
            std::size_t axis = next.y < next.x ? 1 : 0;
            axis = next.z < next[static_cast<int>(axis)] ? 2 : axis;
            const int k = static_cast<int>(axis);
            place[axis] += direction[axis];
            isInside =
                next[k] <= end && place[axis] >= 0 && place[axis] < static_cast<std::int64_t>(cells[axis]);
            next[k] += distance[k];
            findCell(cells);
        }
        void findCell(const std::array<std::uint32_t, 3>& cells) {
            cell = static_cast<std::size_t>((place[2] * cells[1] + place[1]) * cells[0] + place[0]);
        }
    };

    struct Grid {
        base::Vec3d lower{};
        base::Vec3d upper{};
        base::Vec3d cellSize{};
        std::array<std::uint32_t, 3> cells{};
        std::vector<std::uint32_t> starts;  ///< of each cell's leaves, and their end
        std::vector<std::uint32_t> leaves;

        void fill(std::span<const SpatialTree::Node> nodes, std::uint32_t first, std::uint32_t last);
        Walk enter(const base::Vec3d& origin, const base::Vec3d& direction, double tNear, double tFar) const;
        std::int64_t placeAlong(int axis, double coordinate) const;
    };

    std::vector<Grid> grids_;
};

}  // namespace fluxwalk::rays
