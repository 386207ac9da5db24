#pragma once

#include <functional>

#include "core/cli/command.h"
#include "core/cli/report.h"
#include "core/cli/scene_arguments.h"

namespace fluxwalk::cli {

/// A scene and its solution, with what is to be told about them.
struct Solved {
    std::shared_ptr<const scene::Scene> scene;
    std::unique_ptr<solve::Solver> solver;
    Report report;

    ExitCode exitCode() const;
};

/// Loads and solves, with progress and warnings on standard error. Ctrl-C ends it with what is solved.
/// `check`, if given, looks at the scene before the work and may throw.
Solved runSolver(const std::string& command, const SceneArguments& scene, const SolverArguments& solver,
                 const OutputArguments& output, const std::function<void(const scene::Scene&)>& check = {});

/// The solver's last statistics and the files written, for the report.
void completeReport(Solved& solved, std::vector<std::string> outputs);

}  // namespace fluxwalk::cli
