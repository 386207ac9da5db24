#include "core/rays/cell_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluxwalk::rays {

namespace {

/// Boxes reach this part of a cell further than they are: the rounding of a walk.
constexpr double kMargin = 1e-5;

}  // namespace

CellLists::CellLists(const SpatialTree& tree, const base::Executor& executor) : grids_(tree.grids().size()) {
    executor.forRange(grids_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t root = tree.grids()[i].node;
            std::uint32_t last = root;
            while (!tree.nodes()[last].isLeaf()) {
                last = tree.nodes()[last].right;
            }
            Grid& grid = grids_[i];
            grid.cells = tree.grids()[i].cells;
            grid.lower = base::Vec3d(tree.nodes()[root].lower);
            grid.upper = base::Vec3d(tree.nodes()[root].upper);
            grid.cellSize =
                (grid.upper - grid.lower) / base::Vec3d(grid.cells[0], grid.cells[1], grid.cells[2]);
            grid.fill(tree.nodes(), root, last);
        }
    });
}

std::int64_t CellLists::Grid::placeAlong(int axis, double coordinate) const {
    const double place = (coordinate - lower[axis]) / cellSize[axis];
    const double last = static_cast<double>(cells[static_cast<std::size_t>(axis)]) - 1.0;
    return static_cast<std::int64_t>(std::clamp(place, 0.0, last));
}

void CellLists::Grid::fill(std::span<const SpatialTree::Node> nodes, std::uint32_t first,
                           std::uint32_t last) {
    const auto forCells = [&](const auto& body) {
        for (std::uint32_t node = first; node <= last; ++node) {
            if (!nodes[node].isLeaf()) {
                continue;
            }
            std::array<std::int64_t, 3> from{};
            std::array<std::int64_t, 3> to{};
            for (int k = 0; k < 3; ++k) {
                const double margin = kMargin * cellSize[k];
                from[static_cast<std::size_t>(k)] =
                    placeAlong(k, static_cast<double>(nodes[node].lower[k]) - margin);
                to[static_cast<std::size_t>(k)] =
                    placeAlong(k, static_cast<double>(nodes[node].upper[k]) + margin);
            }
            for (std::int64_t z = from[2]; z <= to[2]; ++z) {
                for (std::int64_t y = from[1]; y <= to[1]; ++y) {
                    for (std::int64_t x = from[0]; x <= to[0]; ++x) {
                        body(node, static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x));
                    }
                }
            }
        }
    };
    // Counted, then filled from each cell's end to its start.
    starts.assign(std::size_t{cells[0]} * cells[1] * cells[2] + 1, 0);
    forCells([&](std::uint32_t /*node*/, std::size_t cell) { ++starts[cell]; });
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts) {
        end += start;
        start = end;
    }
    leaves.resize(end);
    forCells([&](std::uint32_t node, std::size_t cell) { leaves[--starts[cell]] = node; });
}

CellLists::Walk CellLists::Grid::enter(const base::Vec3d& origin, const base::Vec3d& direction, double tNear,
                                       double tFar) const {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    Walk walk;
    double start = tNear;
    walk.end = tFar;
    for (int k = 0; k < 3; ++k) {
        if (direction[k] != 0.0) {
            const double a = (lower[k] - origin[k]) / direction[k];
            const double b = (upper[k] - origin[k]) / direction[k];
            start = std::max(start, std::min(a, b));
            walk.end = std::min(walk.end, std::max(a, b));
        }
    }
    if (!(start < kNever)) {
        return walk;
    }
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        walk.place[axis] = placeAlong(k, origin[k] + start * direction[k]);
        walk.direction[axis] = direction[k] > 0.0 ? 1 : -1;
        walk.next[k] = kNever;
        if (direction[k] != 0.0) {
            const auto border = static_cast<double>(walk.place[axis] + (direction[k] > 0.0 ? 1 : 0));
            walk.next[k] = (lower[k] + border * cellSize[k] - origin[k]) / direction[k];
            walk.distance[k] = cellSize[k] / std::abs(direction[k]);
        }
    }
    walk.findCell(cells);
    walk.isInside = true;
    return walk;
}

}  // namespace fluxwalk::rays
