#pragma once

#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::transport {

/// What a form factor lies between.
struct FactorBounds {
    double lower = 0.0;
    double upper = 1.0;
};

/// Bounds, without occlusion, of the form factor from any point of `receiver` to the whole of `source`, both
/// elements: from the corners of planar ones, from the bounding spheres and the cones of normals of curved
/// ones. [0, 1] where the two may touch. (ALGORITHMS 1.4; Lischinski et al. 1994, Stamminger et al. 1997.)
FactorBounds boundPointFactor(const hierarchy::Shape& receiver, const hierarchy::Shape& source);

}  // namespace fluxwalk::transport
