#pragma once

#include "core/solve/state.h"

namespace fluxwalk::solve {

/// Energy balance of the present solution: emitted and absorbed flux from the leaves, escaped flux from
/// `rayCount` cosine rays of the leaves, row sums of closed scenes from the links; the power that pull adds
/// or loses.
Audit auditEnergy(const Problem& problem, std::size_t rayCount);

/// Sum of the form factors that a leaf gathers through its own links and, as linear functions over them, its
/// ancestors': what arrives where everything has radiosity 1. At index of each leaf's node; 0 elsewhere.
/// `scale` multiplies the transfers of each node (Problem::rowScale), or is empty.
std::vector<float> computeRowSums(const Problem& problem, const std::vector<float>& scale);

}  // namespace fluxwalk::solve
