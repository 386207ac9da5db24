#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/surface/surface.h"

/// Elements as regions of a patch: a path of quarterings names a region, and regions map the unit square onto
/// the surface.
namespace fluxwalk::surface {

/// Name of an element below its patch: a leading 1, then two bits for each quartering, first split on top.
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

Region wholePatch(PatchDomain domain);

/// Quarter `child` (0..3) of a region. Quads: child k keeps corner k. Triangles: children 0..2 keep corner k,
/// 3 is the middle. Corner order and orientation are kept.
Region childRegion(const Surface& surface, std::uint32_t patch, const Region& region, unsigned child);

/// All four quarters, for the price of one.
std::array<Region, 4> childRegions(const Surface& surface, std::uint32_t patch, const Region& region);

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

/// Index of the child quarter that holds `uv`.
unsigned childAt(const Surface& surface, std::uint32_t patch, const Region& region, const Vec2d& uv);

}  // namespace fluxwalk::surface
