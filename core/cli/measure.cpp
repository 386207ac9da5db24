#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/cli/core_commands.h"
#include "core/cli/output.h"
#include "core/cli/run_solver.h"
#include "core/cli/sensor_arguments.h"
#include "core/cli/sensor_files.h"
#include "core/image/chart.h"
#include "core/io/image_write.h"
#include "core/solve/state.h"

namespace fluxwalk::cli {

namespace {

struct MeasureArguments {
    SceneArguments scene;
    SolverArguments solver;
    OutputArguments output;
    SensorArguments sensors;
    std::filesystem::path values;
    std::filesystem::path plan;
    bool strict = false;
};

ExitCode runMeasure(const MeasureArguments& arguments) {
    std::vector<std::string> outputs;
    for (const std::filesystem::path& file : {arguments.values, arguments.plan, arguments.output.report}) {
        if (!file.empty()) {
            requireWritable(file);
        }
    }
    if (!arguments.plan.empty() && !(arguments.sensors.grid && arguments.sensors.grid->height)) {
        throw base::UsageError("--plan: only a grid over a plane has one, as in --grid plane:y=0.8,0.25");
    }
    const SensorSource source(arguments.sensors, "measure");
    Solved solved = runSolver("measure", arguments.scene, arguments.solver, arguments.output,
                              [&](const scene::Scene& scene) { source.check(scene); });
    const solve::Problem& problem = solved.solver->problem();
    const image::Grid grid = source.make(*problem.scene, problem.hierarchy.reached());
    const auto kind = arguments.strict ? image::IntervalKind::strict : image::IntervalKind::likely;
    const std::vector<image::Measurement> measured =
        image::measureIntervals(*solved.solver, grid.sensors, kind);
    writeMeasurements(arguments.values, grid.sensors, measured, kind);
    outputs.push_back(arguments.values.string());
    if (!arguments.plan.empty()) {
        const image::Picture plan = image::drawPlan(grid, measured);
        writeOutput([&] { io::writePng(arguments.plan, plan.width, plan.height, plan.pixels); });
        outputs.push_back(arguments.plan.string());
    }
    completeReport(solved, std::move(outputs));
    deliver(solved.report, arguments.output);
    if (!arguments.output.json && !arguments.output.quiet) {
        printText(describeMeasurements(measured, kind));
    }
    return solved.exitCode();
}

}  // namespace

Command measureCommand() {
    return {"measure", "Solve a scene and write the illuminance at sensors in lux, each with its interval.",
            [](CLI::App& app) {
                const auto arguments = std::make_shared<MeasureArguments>();
                // Sensors gather through the links: the mesh may be coarser than their values.
                arguments->solver.options.errorOf = solve::ErrorOf::gathered;
                addSceneOptions(app, arguments->scene);
                addSensorOptions(app, arguments->sensors);
                app.add_flag(
                       "--strict", arguments->strict,
                       "In place of the interval that holds 99 of 100 true values: the most and the least "
                       "that the light could be, given the solution; wide wherever it is not certain what "
                       "stands in the way.")
                    ->group("Sensors");
                addSolverOptions(app, arguments->solver);
                app.add_option(
                       "-o,--output", arguments->values,
                       "The same rows with E_r,E_g,E_b, lux, the interval's ends low and high, and solid, "
                       "which is 1 for sensors inside solids; a name that ends in .json gets JSON.")
                    ->required()
                    ->type_name("OUT.csv|json")
                    ->group("Output");
                app.add_option("--plan", arguments->plan,
                               "A grid's plane in false colours with a legend in lux, seen from above.")
                    ->type_name("OUT.png")
                    ->group("Output");
                addOutputOptions(app, arguments->output);
                return [arguments] { return runMeasure(*arguments); };
            }};
}

}  // namespace fluxwalk::cli
