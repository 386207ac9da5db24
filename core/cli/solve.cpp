#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/cli/core_commands.h"
#include "core/cli/lit_meshes.h"
#include "core/cli/output.h"
#include "core/cli/run_solver.h"
#include "core/io/lit_gltf.h"

namespace fluxwalk::cli {

namespace {

struct SolveArguments {
    SceneArguments scene;
    SolverArguments solver;
    OutputArguments output;
    std::filesystem::path lit;
};

void requireOutputs(const SolveArguments& arguments) {
    if (arguments.lit.extension() != ".glb") {
        throw base::UsageError("--output: '" + arguments.lit.string() + "' does not end in .glb");
    }
    requireWritable(arguments.lit);
    if (!arguments.output.report.empty()) {
        requireWritable(arguments.output.report);
    }
}

ExitCode runSolve(const SolveArguments& arguments) {
    requireOutputs(arguments);
    Solved solved = runSolver("solve", arguments.scene, arguments.solver, arguments.output);
    const scene::LitMeshes meshes = makeLitMeshes(solved, arguments.output);
    const std::shared_ptr<const scene::Scene> lit =
        scene::relightScene(solved.scene, solved.solver->options().lighting);
    writeOutput([&] { io::writeLitGltf(arguments.lit, *lit, meshes, {io::chooseExposure(*lit, meshes)}); });
    completeReport(solved, {arguments.lit.string()});
    deliver(solved.report, arguments.output);
    return solved.exitCode();
}

}  // namespace

Command solveCommand() {
    return {"solve", "Solve a scene and write the lit mesh, which opens in any glTF viewer.",
            [](CLI::App& app) {
                const auto arguments = std::make_shared<SolveArguments>();
                addSceneOptions(app, arguments->scene);
                addSolverOptions(app, arguments->solver);
                app.add_option("-o,--output", arguments->lit,
                               "Lit mesh: light in the vertex colours, true lux in _IRRADIANCE.")
                    ->required()
                    ->type_name("OUT.glb")
                    ->group("Output");
                addOutputOptions(app, arguments->output);
                return [arguments] { return runSolve(*arguments); };
            }};
}

}  // namespace fluxwalk::cli
