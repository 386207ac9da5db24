#pragma once

#include <functional>
#include <span>

#include "core/solve/state.h"

/// Pictures from the midst of a refinement.
namespace fluxwalk::solve {

/// Whether all pairs that wait, `underway` or pending, could stand as links: then these and the accepted ones
/// tile the scene.
bool canPreview(const Problem& problem, std::span<const Decision> underway);

struct PreviewOptions {
    int mostSweeps = 2;
    double residual = 0.04;  ///< relative change of power in a sweep that is the last one
    /// Radiosity of whatever a leaf has no link to yet, lm/m2.
    double ambient = 0.0;
};

/// Takes those that could stand for links, sweeps over them, calls `show`, and puts everything back as it
/// was: what is shown, and when, decides nothing.
void preview(Problem& problem, std::span<const Decision> underway, const PreviewOptions& options,
             const std::function<void()>& show);

}  // namespace fluxwalk::solve
