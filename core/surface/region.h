#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/surface/surface.h"

/// Elements as regions of a patch: a path of splits names a region, and regions map the unit square onto
/// the surface.
namespace fluxwalk::surface {

/// Name of an element below its patch: a leading 1, then two bits for each split, the first on top.
using Path = std::uint64_t;
inline constexpr Path kRootPath = 1;
inline constexpr unsigned kMaxLevel = 30;

constexpr Path childPath(Path parent, unsigned child) {
    return (parent << 2) | child;
}
constexpr Path parentPath(Path path) {
    return path >> 2;
}
constexpr unsigned pathLevel(Path path) {
    return (static_cast<unsigned>(std::bit_width(path)) - 1) / 2;
}
/// Child index taken at `level` (0 is the first split), which must be below pathLevel(path).
constexpr unsigned pathStep(Path path, unsigned level) {
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): the analyzer does not know bit_width
    return static_cast<unsigned>(path >> (2 * (pathLevel(path) - 1 - level))) & 3u;
}

/// How a region is cut in four: quarters, or for quads strips that follow each other along u or v.
enum class Split : std::uint8_t { quarters, stripsAlongU, stripsAlongV };

/// How elements of `level` are cut.
constexpr Split splitAt(const Strips& strips, unsigned level) {
    const bool isStrips = level >= strips.from && level < strips.from + strips.levels;
    return !isStrips ? Split::quarters : strips.alongV ? Split::stripsAlongV : Split::stripsAlongU;
}
inline Split splitAt(const Surface& surface, std::uint32_t patch, unsigned level) {
    return splitAt(surface.strips(patch), level);
}

/// Deepest level of a patch's elements: strips take two of the halvings that parameters are exact in.
inline unsigned deepestLevel(const Surface& surface, std::uint32_t patch) {
    return kMaxLevel - surface.strips(patch).levels;
}

Region wholePatch(PatchDomain domain);

/// Part `child` (0..3) of a region. Quarters of quads: child k keeps corner k; of triangles: children 0..2
/// keep corner k, 3 is the middle. Strips: in the order of the parameter. Corner order and orientation are
/// kept.
Region childRegion(const Surface& surface, std::uint32_t patch, const Region& region, Split split,
                   unsigned child);

/// All four parts, for the price of one.
std::array<Region, 4> childRegions(const Surface& surface, std::uint32_t patch, const Region& region,
                                   Split split);

/// The region that a path names, by descending from the whole patch.
Region regionOf(const Surface& surface, std::uint32_t patch, Path path);

/// A parameter and the measure d(u,v) / d(s,t) of the map that led to it.
struct RegionPoint {
    Vec2d uv{};
    double jacobian = 0.0;
};

/// Maps the unit square onto a region: bilinearly for quads; for triangles by the area-preserving square-root
/// map (s,t) -> (1 - sqrt s, t sqrt s), whose measure is the triangle's area everywhere.
RegionPoint mapToRegion(const Region& region, const Vec2d& st);

/// Index of the part that holds `uv`.
unsigned childAt(const Surface& surface, std::uint32_t patch, const Region& region, Split split,
                 const Vec2d& uv);

}  // namespace fluxwalk::surface
