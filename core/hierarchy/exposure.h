#pragma once

#include "core/hierarchy/hierarchy.h"

/// Elements know which of their parts lie inside other solids: those neither receive nor send.
namespace fluxwalk::hierarchy {

/// Cells of a region (see Shape::exposedCells) from whose middle a ray along the normal does not at once meet
/// a side that light never reaches, which is the inside of a solid that stands there.
std::uint16_t findExposedCells(const rays::RayScene& rays, const ReachedSides& reached,
                               const surface::Surface& surface, std::uint32_t patch, bool back,
                               const surface::Region& region);

/// Part of the unit square that the cells cover (regions are mapped by nearly constant measure).
float exposedFraction(std::uint16_t cells);

}  // namespace fluxwalk::hierarchy
