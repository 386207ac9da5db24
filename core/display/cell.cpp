#include "core/display/cell.h"

namespace fluxwalk::display {

namespace {

// Corners 1 and 2 of a quad, and corner 1 of a triangle, lie one step along x; the others likewise.
constexpr std::array<GridPoint, 4> kQuadSteps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
constexpr std::array<GridPoint, 4> kTriangleSteps{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};

// Unsigned arithmetic wraps, so that one expression serves both orientations.
GridPoint stepFrom(const GridPoint& p, const GridPoint& step, const GridPoint& extent, bool inverted) {
    const std::uint32_t x = step.x * extent.x;
    const std::uint32_t y = step.y * extent.y;
    return inverted ? GridPoint{p.x - x, p.y - y} : GridPoint{p.x + x, p.y + y};
}

// Moves a cell's place to that of its part.
void descend(Cell& cell, surface::Split split, unsigned child) {
    if (split != surface::Split::quarters) {
        const bool alongX = split == surface::Split::stripsAlongU;
        std::uint32_t& extent = alongX ? cell.extent.x : cell.extent.y;
        extent /= 4;
        (alongX ? cell.origin.x : cell.origin.y) += child * extent;
        return;
    }
    cell.extent = {cell.extent.x / 2, cell.extent.y / 2};
    const auto& steps = cell.cornerCount == 4 ? kQuadSteps : kTriangleSteps;
    cell.origin = stepFrom(cell.origin, steps[child], cell.extent, cell.inverted);
    if (cell.cornerCount == 3) {
        cell.inverted = cell.inverted != (child == 3);
    }
}

Cell childOf(const Cell& cell) {
    Cell child = cell;
    child.middles.fill(kNone);
    child.firstChild = 0;
    child.childCount = 0;
    return child;
}

}  // namespace

std::array<GridPoint, 4> cornersOf(const Cell& cell) {
    const auto& steps = cell.cornerCount == 4 ? kQuadSteps : kTriangleSteps;
    std::array<GridPoint, 4> corners;
    for (unsigned i = 0; i < 4; ++i) {
        corners[i] = stepFrom(cell.origin, steps[i], cell.extent, cell.inverted);
    }
    return corners;
}

Cell makeCell(const PatchTopology& topology, std::uint32_t patch, surface::Path path, std::uint32_t source) {
    Cell cell;
    cell.path = path;
    cell.patch = patch;
    cell.source = source;
    cell.extent = {kGridSize, kGridSize};
    cell.cornerCount = static_cast<std::uint8_t>(topology.cornerCount(patch));
    const surface::Strips strips = topology.strips(patch);
    const unsigned levels = surface::pathLevel(path);
    for (unsigned level = 0; level < levels; ++level) {
        descend(cell, surface::splitAt(strips, level), surface::pathStep(path, level));
    }
    return cell;
}

Cell partOf(const Cell& cell, surface::Split split, unsigned child) {
    Cell part = childOf(cell);
    part.path = surface::childPath(cell.path, child);
    descend(part, split, child);
    return part;
}

Cell halfOf(const Cell& cell, Axis axis, unsigned half) {
    Cell out = childOf(cell);
    out.cuts = surface::childPath(cell.cuts, cutStep(axis, half));
    std::uint32_t& extent = axis == Axis::x ? out.extent.x : out.extent.y;
    extent /= 2;
    (axis == Axis::x ? out.origin.x : out.origin.y) += half * extent;
    return out;
}

bool canBeHalved(const Cell& cell, Axis axis) {
    constexpr std::uint32_t kLeast = kGridSize >> surface::kMaxLevel;
    return surface::pathLevel(cell.cuts) < kMaxCuts &&
           (axis == Axis::x ? cell.extent.x : cell.extent.y) > kLeast;
}

}  // namespace fluxwalk::display
