#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/rays/build_item.h"

namespace fluxwalk::rays {

/// A box of cells of a regular grid.
struct CellRange {
    Float4 origin{};  ///< of the whole grid
    Float4 cellSize{};
    std::array<std::uint32_t, 3> first{};
    std::array<std::uint32_t, 3> last{};  ///< one past the end

    /// Numbers of cells along the axes.
    std::array<std::uint32_t, 3> counts() const {
        return {last[0] - first[0], last[1] - first[1], last[2] - first[2]};
    }
    bool isOneCell() const { return counts() == std::array<std::uint32_t, 3>{1, 1, 1}; }
};

/// Grid over `within` where the items fill it evenly: nearly as many cells are occupied as if the items had
/// been thrown in at random, none holds very many, and items are no larger than a few cells.
std::optional<CellRange> findGrid(std::span<const BuildItem> items, const Extent& within);

/// Cuts the range between two layers of cells and reorders the items by their middles' cells; halves that
/// would be empty are cut off and forgotten. Returns the size of the first half and its range in `cells`,
/// that of the second in `second`; 0 where all items lie in one cell, which `cells` then is.
std::size_t splitCells(std::span<BuildItem> items, CellRange& cells, CellRange& second);

}  // namespace fluxwalk::rays
