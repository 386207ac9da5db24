#pragma once

#include <vector>

#include "core/solve/options.h"
#include "core/solve/statistics.h"

/// What new options ask of a solution that stands.
namespace fluxwalk::solve {

enum class Turn : std::uint8_t {
    none,     ///< the loop goes on or rests, as its error and threshold say
    finer,    ///< links are judged again by the threshold there is: more of them may be refined
    coarser,  ///< they are found again from the root by the threshold there is, or by a larger one
    anew      ///< the same, beginning with the first threshold; the light stays
};

struct Asked {
    Turn turn = Turn::none;
    double threshold = 0.0;  ///< Turn::coarser: lux, 0 for the one there is
};

/// What the step from one set of options to another asks for. A raised error target goes back to the largest
/// threshold of `history` that reached it.
Asked compareOptions(const Options& before, const Options& after, const std::vector<HistoryEntry>& history);

/// Of two requests of which neither is done yet.
Asked mergeAsked(const Asked& earlier, const Asked& later);

/// Whether the new options need a new Solver: seed, clusters, what they are taken for and what answers rays
/// are fixed when it is made.
bool needsNewSolver(const Options& before, const Options& after);

}  // namespace fluxwalk::solve
