#pragma once

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// Integral of the area measure over a region in m2, to about 1e-12: Surface::area's quadrature on quarters,
/// ever smaller ones until that changes nothing.
double integrateArea(const Surface& surface, std::uint32_t patch, const Region& region);

}  // namespace fluxwalk::surface
