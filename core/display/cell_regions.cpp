#include "core/display/cell_regions.h"

#include <algorithm>

namespace fluxwalk::display {

namespace {

using surface::Path;
using surface::pathLevel;
using surface::pathStep;
using surface::Region;

unsigned countCommonSteps(Path a, Path b) {
    const unsigned common = std::min(pathLevel(a), pathLevel(b));
    unsigned shared = 0;
    while (shared < common && pathStep(a, shared) == pathStep(b, shared)) {
        ++shared;
    }
    return shared;
}

}  // namespace

std::array<Region, 2> halfRegions(const surface::Surface& surface, std::uint32_t patch, const Region& region,
                                  Axis axis) {
    const auto& c = region.corners;
    if (axis == Axis::x) {
        const Vec2d e0 = surface.splitPoint(patch, c[0], c[1]);
        const Vec2d e2 = surface.splitPoint(patch, c[2], c[3]);
        return {Region{{c[0], e0, e2, c[3]}, 4}, Region{{e0, c[1], c[2], e2}, 4}};
    }
    const Vec2d e1 = surface.splitPoint(patch, c[1], c[2]);
    const Vec2d e3 = surface.splitPoint(patch, c[3], c[0]);
    return {Region{{c[0], c[1], e1, e3}, 4}, Region{{e3, e1, c[2], c[3]}, 4}};
}

const Region& RegionCursor::at(const Cell& cell) {
    const unsigned levels = pathLevel(cell.path);
    const unsigned cuts = pathLevel(cell.cuts);
    if (cell.patch != last_.patch) {
        whole_ = surface::wholePatch(surface_.domain(cell.patch));
        partDepth_ = 0;
    } else {
        partDepth_ = std::min(partDepth_, countCommonSteps(cell.path, last_.path) + 1);
    }
    // Halves of a cell hold both: a differing last step needs none anew, unless its axis differs.
    const bool isSameLeaf = cell.patch == last_.patch && cell.path == last_.path;
    const unsigned common = isSameLeaf ? countCommonSteps(cell.cuts, last_.cuts) : 0;
    const bool isSibling =
        isSameLeaf && common < std::min(cuts, pathLevel(last_.cuts)) &&
        axisOfStep(pathStep(cell.cuts, common)) == axisOfStep(pathStep(last_.cuts, common));
    halfDepth_ = std::min(halfDepth_, common + (isSibling ? 1u : 0u));
    for (; partDepth_ < levels; ++partDepth_) {
        parts_[partDepth_] = surface::childRegions(surface_, cell.patch, partAt(cell.path, partDepth_),
                                                   surface::splitAt(surface_, cell.patch, partDepth_));
    }
    for (; halfDepth_ < cuts; ++halfDepth_) {
        halves_[halfDepth_] = halfRegions(surface_, cell.patch, halfAt(cell, halfDepth_),
                                          axisOfStep(pathStep(cell.cuts, halfDepth_)));
    }
    last_ = {cell.patch, cell.path, cell.cuts};
    return halfAt(cell, cuts);
}

}  // namespace fluxwalk::display
