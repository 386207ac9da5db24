#pragma once

#include "core/cli/run_solver.h"

namespace fluxwalk::cli {

/// The displayed meshes of a solution, with their light as solve::Options::display says; gathering it shows
/// its progress. Ctrl-C leaves the light interpolated where it is not gathered yet.
scene::LitMeshes makeLitMeshes(const Solved& solved, const OutputArguments& output);

/// The same as a snapshot, with what `detail` asks for.
solve::Snapshot showSolved(const Solved& solved, const solve::Detail& detail, const OutputArguments& output);

}  // namespace fluxwalk::cli
