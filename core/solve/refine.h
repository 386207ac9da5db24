#pragma once

#include <functional>

#include "core/solve/state.h"

namespace fluxwalk::solve {

/// Refines until no link's error exceeds `threshold` (lux, see Oracle): breadth-first waves of bounds,
/// deferred coefficients in one batch, then accept, split or drop (ALGORITHMS 1.2, 1.13). The first call
/// starts from one link of the root onto itself, later ones from the links that stand. Returns whether
/// anything changed. `shouldStop` is asked between waves: then all pairs still open are accepted as they are,
/// so that links tile the scene at all times.
bool refineLinks(Problem& problem, double threshold, const std::function<bool()>& shouldStop);

}  // namespace fluxwalk::solve
