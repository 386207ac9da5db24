#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/hierarchy/hierarchy.h"

/// Elements know which of their parts lie inside other solids, and which lie in gaps so narrow that light
/// does not get far into them, at the scale of their cells: those neither receive nor send. Smaller elements
/// have smaller cells, so that refinement opens a gap from its rim inwards.
namespace fluxwalk::hierarchy {

/// As in Shape.
struct Exposure {
    std::uint16_t cells = 0xffff;
    std::uint8_t places = Shape::kPlaces;
    std::uint8_t placesOfParent = Shape::kPlaces;
    bool isCovered = false;
};

/// A cell is hidden if everywhere in it rays along the normal at once meet a side that light never reaches,
/// which is the inside of a solid that stands there; or if they all end within a quarter of the cells' size
/// and nearly all others within one: then the cell lies in a narrow gap. Where `mayEmit` holds for either
/// side of a gap, it does not count as one. `cellSizes` (m): of the element's cells and its parent's, which
/// are not smaller.
Exposure findExposure(const rays::RayScene& rays, const ReachedSides& reached,
                      const surface::Surface& surface, std::uint32_t patch, bool back,
                      const surface::Region& region, const std::array<double, 2>& cellSizes,
                      const std::function<bool(base::ObjectId)>& mayEmit, bool doesEmit);

}  // namespace fluxwalk::hierarchy
