#pragma once

#include "core/solve/state.h"

namespace fluxwalk::solve {

/// Largest change of a transfer by row scaling.
inline constexpr float kMaxRowScaling = 0.05f;

/// Factors for Problem::rowScale that bring the row sums towards 1 (closed scenes) or below 1 (open ones).
/// Both ends of a link take part, so reciprocity stays exact; no transfer changes by more than kMaxRowScaling
/// (ALGORITHMS 1.7).
std::vector<float> computeRowScaling(const Problem& problem);

/// Part of what it gathers that each leaf keeps, so that light cannot grow without end: where factors sum to
/// so much more than 1 that the leaf would send on more than it could have got (surfaces of a model that lie
/// closer upon each other than rays can tell). By node; empty where all keep everything.
std::vector<float> limitRows(const Problem& problem);

}  // namespace fluxwalk::solve
