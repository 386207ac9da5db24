#pragma once

#include <functional>
#include <span>

#include "core/solve/state.h"

namespace fluxwalk::solve {

struct Refined {
    bool hasChanged = false;    ///< there was something to refine
    Limit limit = Limit::none;  ///< what left some of it as it was
};

/// Refines until no link's error exceeds `threshold` (lux, see Oracle): waves of bounds, deferred
/// coefficients in one batch, then accept, split or drop (ALGORITHMS 1.2, 1.13); breadth first as long as
/// `budget` is far, then the largest errors first. Goes on with the pairs that are pending; else starts from
/// the links that stand, or, where there are none, from one link of the root onto itself. `shouldStop` is
/// asked between waves, where the pending pairs and links are all there is to go on from; `isCalledAway` (may
/// be empty) some milliseconds apart within them, with the pairs of the wave that are still to be opened,
/// beside those that are pending. When either says so, or the budget is spent, all pairs that were not opened
/// are accepted as they are, so that links tile the scene at all times. Throws base::UsageError where not
/// even the coarsest links fit into the budget.
Refined refineLinks(Problem& problem, double threshold, const Budget& budget,
                    const std::function<bool()>& shouldStop,
                    const std::function<bool(std::span<const Decision>)>& isCalledAway = {});

}  // namespace fluxwalk::solve
