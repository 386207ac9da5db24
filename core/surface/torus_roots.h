#pragma once

#include <array>
#include <limits>

#include "core/base/vec.h"

namespace fluxwalk::surface {

/// Where a line passes through the torus about +Y of ring radius 1 and tube radius `tube`: the distances from
/// `foot` along the unit vector `along`, ascending, then infinity. `foot` is the line's point nearest to the
/// centre. Only those from `from` to `to`, which may be infinite, are looked for (and some beyond may be
/// among them). Tangents within rounding may count as two crossings or none; other crossings are right to
/// rounding.
std::array<double, 4> torusCrossings(double tube, const base::Vec3d& foot, const base::Vec3d& along,
                                     double from, double to);

}  // namespace fluxwalk::surface
