#include "core/cli/run_solver.h"

#include "core/base/memory.h"
#include "core/cli/checkpointing.h"
#include "core/cli/interrupt.h"
#include "core/cli/output.h"
#include "core/cli/progress.h"
#include "core/scene/texture.h"

namespace fluxwalk::cli {

ExitCode Solved::exitCode() const {
    return report.outcome == solve::Outcome::stopped ? ExitCode::interrupted : ExitCode::success;
}

Solved runSolver(const std::string& command, const SceneArguments& sceneArguments,
                 const SolverArguments& solverArguments, const OutputArguments& output,
                 const std::function<void(const scene::Scene&)>& check) {
    Checkpointing checkpointing(solverArguments);
    Solved solved;
    solved.scene = std::make_shared<const scene::Scene>(loadScene(sceneArguments));
    if (check) {
        check(*solved.scene);
    }
    if (!output.quiet) {
        for (const std::string& warning : solved.scene->warnings) {
            printWarning(warning);
        }
    }
    solved.report.command = command;
    solve::Options options = checkpointing.options();
    options.lighting = turnLights(solverArguments.lights, *solved.scene, options.lighting);
    const std::shared_ptr<const scene::Scene> lit = scene::relightScene(solved.scene, options.lighting);
    solved.report.scene = scene::describeScene(*lit, scene::TextureSet(*lit));
    solved.report.arguments = solverArguments;
    solved.report.arguments.options = options;
    solved.solver = checkpointing.makeSolver(solved.scene, options, solverArguments.threads);

    const Interrupt interrupt;
    Progress progress(stderr, chooseStyle(stderr, output.quiet));
    solve::Callbacks callbacks;
    callbacks.shouldStop = [] { return Interrupt::isRequested(); };
    callbacks.resumable = [&](solve::Moment moment) { checkpointing.keep(*solved.solver, moment); };
    callbacks.progress = [&](double fraction, const char* stage) { progress.update(fraction, stage); };
    solved.report.outcome = solved.solver->solve(callbacks);
    checkpointing.finish();
    return solved;
}

void completeReport(Solved& solved, std::vector<std::string> outputs) {
    solved.report.statistics = solved.solver->statistics();
    solved.report.statistics.counters.bytesCounted = solved.solver->countBytes();
    solved.report.outputs = std::move(outputs);
    solved.report.bytesPeak = base::peakMemory();
}

}  // namespace fluxwalk::cli
