#pragma once

#include <array>
#include <vector>

#include "core/display/patch_topology.h"
#include "core/surface/region.h"

namespace fluxwalk::display {

/// Direction in a patch's grid in which a cell is cut in two.
enum class Axis : std::uint8_t { x, y };

/// A display leaf: a leaf of the solution, a part that balancing made of one, or what post-refinement cut
/// out of those.
struct Cell {
    surface::Path path = surface::kRootPath;
    /// Cuts in two below `path`, quads only: a leading 1, then two bits for each, first cut on top; those of
    /// cutStep.
    surface::Path cuts = surface::kRootPath;
    std::uint32_t patch = 0;
    std::uint32_t source = 0;  ///< the solution's leaf that holds it, as numbered by the caller
    GridPoint origin;          ///< corner 0
    GridPoint extent;          ///< how far it reaches along x and y
    std::array<std::uint32_t, 4> points{};
    /// Points in the middles of the edges between corners i and i + 1, kNone where there is none.
    std::array<std::uint32_t, 4> middles{kNone, kNone, kNone, kNone};
    std::uint32_t firstChild = 0;  ///< of `childCount` in a row
    std::uint8_t childCount = 0;   ///< used while refining; leaves have none
    std::uint8_t cornerCount = 4;
    bool inverted = false;  ///< triangle whose corners lie towards smaller coordinates
};

/// A step of Cell::cuts: into which half, seen along which axis.
constexpr unsigned cutStep(Axis axis, unsigned half) {
    return 2 * static_cast<unsigned>(axis) + half;
}
constexpr Axis axisOfStep(unsigned step) {
    return static_cast<Axis>(step >> 1u);
}
/// Cuts that a Cell can hold.
inline constexpr unsigned kMaxCuts = 31;

/// Corners in the patch's grid; the fourth of a triangle means nothing.
std::array<GridPoint, 4> cornersOf(const Cell& cell);

/// Cell of the leaf that `path` names; its points are not numbered yet.
Cell makeCell(const PatchTopology& topology, std::uint32_t patch, surface::Path path, std::uint32_t source);

/// Part `child` of a cell that is not cut in two. Corners are those of surface::childRegion.
Cell partOf(const Cell& cell, surface::Split split, unsigned child);

/// Half 0 or 1 of a quad along `axis`.
Cell halfOf(const Cell& cell, Axis axis, unsigned half);
bool canBeHalved(const Cell& cell, Axis axis);

}  // namespace fluxwalk::display
