#pragma once

#include <optional>

#include "core/base/named_arrays.h"
#include "core/solve/state.h"
#include "core/solve/turn.h"

/// A solve between two waves, sweeps or levels as named arrays, and back. All that decides what comes next is
/// in them, so that a solve that goes on from them gets the same bits as one that was never interrupted.
namespace fluxwalk::solve {

/// What comes next within a level.
enum class Stage : std::uint8_t {
    tighten,
    refine,
    sweep,
    follow  ///< sweeps that let the light follow turned lights, over the links that stand
};

/// What the loop over the levels carries along, beside the Problem.
struct LoopState {
    Stage stage = Stage::tighten;
    int sweeps = 0;             ///< of this level, or that follow turned lights, that are done
    bool isCoarsening = false;  ///< this level began anew at the root
    bool isStarted = false;
    double ambient = 0.0;       ///< lux, first guess for what is not lit yet
    std::vector<Rgb> gathered;  ///< lux at the probes, after the last level
    Asked asked;                ///< by new options, of the next level
    bool hasChanged = true;     ///< the last level changed links
    /// Of statistics.times.total, what was spent before the program started: no part of a time limit.
    double secondsBefore = 0.0;
    std::optional<std::uint64_t> sceneHash;  ///< once it was asked for
};

/// The state at a Moment. The lights are as the solution follows them. Nodes come with their names and the
/// light that is not given by the scene, links with every field, in their orders; units are those of the
/// structures.
base::NamedArrays saveState(const Problem& problem, LoopState& loop);

/// Puts a state into a problem that was just made of the same scene with the same seed and builders, and
/// whose other options may differ. Throws base::FileError that names `file` where the arrays are of another
/// kind, version or scene, or hold what cannot be; the problem is then good for nothing.
void restoreState(Problem& problem, LoopState& loop, const base::NamedArrays& arrays,
                  const std::string& file);

/// The options that a state was solved with, lights included; those that the table of options does not know,
/// and the limits of time and memory, come from `others`. Throws base::FileError.
Options storedOptions(const base::NamedArrays& arrays, const Options& others, const std::string& file);

}  // namespace fluxwalk::solve
