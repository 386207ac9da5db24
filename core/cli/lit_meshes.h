#pragma once

#include <span>

#include "core/cli/run_solver.h"
#include "core/image/display_gather.h"

namespace fluxwalk::cli {

/// The displayed meshes of a solution, with their light as solve::Options::display says; gathering it shows
/// its progress. Ctrl-C leaves the light interpolated where it is not gathered yet.
scene::LitMeshes makeLitMeshes(const Solved& solved, const OutputArguments& output);

/// The same as a snapshot, with what `detail` asks for; light is gathered only where one of `looks` sees it.
solve::Snapshot showSolved(const Solved& solved, const solve::Detail& detail, const OutputArguments& output,
                           std::span<const image::Look> looks);

}  // namespace fluxwalk::cli
