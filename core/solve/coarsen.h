#pragma once

#include "core/solve/state.h"

/// Un-refinement (ALGORITHMS 1.11, check 26): links go back up where the light of now and a higher threshold
/// allow it. Coefficients are pure functions of their pairs, so the links that would stand higher up are not
/// kept but found again from the root, and are those of a fresh refinement on the same light. What was once
/// computed is known (known_pairs.h).
namespace fluxwalk::solve {

/// Whether the threshold that the options name is far enough above the one that the links were refined to:
/// more than twice, so that small turns cost nothing.
bool asksForCoarser(const Problem& problem);

/// Takes all links for known pairs: the next refinement begins at the root and reads the light that stands.
void dropLinks(Problem& problem);

/// Whether elements are split that are too small to be by the options of now.
bool hasTooSmallElements(const Problem& problem);

/// Removes elements at which, and below which, no link ends, and that have no such siblings.
void pruneElements(Problem& problem);

}  // namespace fluxwalk::solve
