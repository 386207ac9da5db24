#include "core/rays/grid_split.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fluxwalk::rays {

namespace {

/// Fewer items are no region.
constexpr std::size_t kLeastItems = 64;
constexpr double kItemsPerCell = 1.5;
constexpr std::uint32_t kMostItemsInCell = 16;
/// Occupied cells, as part of what random places would occupy.
constexpr double kLeastEvenness = 0.9;
/// Cells that an item overlaps, in the mean.
constexpr double kMostOverlaps = 8.0;
constexpr double kMostCellsAlong = 1024.0;

int cellAlong(const CellRange& cells, const BuildItem& item, int axis, std::uint32_t count) {
    const float place = (0.5f * item.center()[axis] - cells.origin[axis]) / cells.cellSize[axis];
    return std::clamp(static_cast<int>(place), 0, static_cast<int>(count) - 1);
}

// Cells as close to cubes as whole numbers allow; one layer along axes that are thinner than a cell.
std::array<std::uint32_t, 3> chooseCounts(const Float4& size, double wanted) {
    std::array<bool, 3> isThick{};
    for (std::size_t k = 0; k < 3; ++k) {
        isThick[k] = size[static_cast<int>(k)] > 0.0f;
    }
    std::array<std::uint32_t, 3> counts{1, 1, 1};
    for (int round = 0; round < 3; ++round) {
        double measure = 1.0;
        int axes = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            measure *= isThick[k] ? static_cast<double>(size[static_cast<int>(k)]) : 1.0;
            axes += isThick[k] ? 1 : 0;
        }
        if (axes == 0) {
            break;
        }
        const double side = std::pow(measure / wanted, 1.0 / axes);
        bool isSettled = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto extent = static_cast<double>(size[static_cast<int>(k)]);
            if (isThick[k] && extent < side) {
                isThick[k] = false;
                isSettled = false;
            }
            counts[k] =
                isThick[k]
                    ? static_cast<std::uint32_t>(std::clamp(std::round(extent / side), 1.0, kMostCellsAlong))
                    : 1;
        }
        if (isSettled) {
            break;
        }
    }
    return counts;
}

}  // namespace

std::optional<CellRange> findGrid(std::span<const BuildItem> items, const Extent& within) {
    if (items.size() < kLeastItems) {
        return std::nullopt;
    }
    const auto number = static_cast<double>(items.size());
    CellRange grid;
    grid.last = chooseCounts(within.size(), number / kItemsPerCell);
    grid.origin = within.lower;
    for (int k = 0; k < 3; ++k) {
        grid.cellSize[k] =
            std::max(within.size()[k], 1e-20f) / static_cast<float>(grid.last[static_cast<std::size_t>(k)]);
    }
    double overlaps = 0.0;
    for (const BuildItem& item : items) {
        const Float4 span = (item.upper - item.lower) / grid.cellSize + 1.0f;
        overlaps += static_cast<double>(std::min(span[0], static_cast<float>(grid.last[0])) *
                                        std::min(span[1], static_cast<float>(grid.last[1])) *
                                        std::min(span[2], static_cast<float>(grid.last[2])));
    }
    if (overlaps > kMostOverlaps * number) {
        return std::nullopt;
    }
    const std::size_t cells = std::size_t{grid.last[0]} * grid.last[1] * grid.last[2];
    if (cells < kLeastItems / 4) {
        return std::nullopt;
    }
    std::vector<std::uint8_t> held(cells, 0);
    std::size_t occupied = 0;
    for (const BuildItem& item : items) {
        std::size_t at = 0;
        for (int k = 2; k >= 0; --k) {
            const std::uint32_t count = grid.last[static_cast<std::size_t>(k)];
            at = at * count + static_cast<std::size_t>(cellAlong(grid, item, k, count));
        }
        occupied += held[at] == 0 ? 1u : 0u;
        if (++held[at] > kMostItemsInCell) {
            return std::nullopt;
        }
    }
    const auto all = static_cast<double>(cells);
    if (static_cast<double>(occupied) < kLeastEvenness * all * (1.0 - std::exp(-number / all))) {
        return std::nullopt;
    }
    return grid;
}

std::size_t splitCells(std::span<BuildItem> items, CellRange& cells, CellRange& second) {
    while (!cells.isOneCell()) {
        int axis = 0;
        float longest = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t count = cells.counts()[static_cast<std::size_t>(k)];
            const float length = static_cast<float>(count) * cells.cellSize[k];
            if (count > 1 && length > longest) {
                longest = length;
                axis = k;
            }
        }
        const auto a = static_cast<std::size_t>(axis);
        const std::uint32_t border = cells.first[a] + (cells.last[a] - cells.first[a]) / 2;
        const auto middle = std::partition(items.begin(), items.end(), [&](const BuildItem& item) {
            return cellAlong(cells, item, axis, cells.last[a]) < static_cast<int>(border);
        });
        const auto count = static_cast<std::size_t>(middle - items.begin());
        second = cells;
        second.first[a] = border;
        if (count == 0) {
            cells = second;
            continue;
        }
        cells.last[a] = border;
        if (count < items.size()) {
            return count;
        }
    }
    return 0;
}

}  // namespace fluxwalk::rays
