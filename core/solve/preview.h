#pragma once

#include <functional>
#include <span>

#include "core/solve/state.h"

/// Pictures from the midst of a refinement.
namespace fluxwalk::solve {

/// Whether all pairs that wait, `underway` or pending, could stand as links: then these and the accepted ones
/// tile the scene.
bool canPreview(const Problem& problem, std::span<const Decision> underway);

/// Takes them for links, sweeps over them, calls `show`, and puts everything back as it was: what is shown,
/// and when, decides nothing. Sweeps until one changes no more than `residual` of the power, `most` times.
void preview(Problem& problem, std::span<const Decision> underway, int most, double residual,
             const std::function<void()>& show);

}  // namespace fluxwalk::solve
