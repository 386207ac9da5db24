#pragma once

#include "core/hierarchy/hierarchy.h"

/// Certificates that two nodes do not see each other.
namespace fluxwalk::solve {

/// Whether `other` lies behind the plane of `plane`, within `tolerance` (m). False where that is no plane.
bool isBehind(const hierarchy::Shape& plane, const hierarchy::Shape& other, float tolerance);

/// Whether no normal of `from` has a direction to `to` in its half-space (ALGORITHMS 1.4, facing test).
bool facesAway(const hierarchy::Shape& from, const hierarchy::Shape& to);

}  // namespace fluxwalk::solve
