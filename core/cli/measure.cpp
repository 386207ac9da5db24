#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/cli/core_commands.h"
#include "core/cli/output.h"
#include "core/cli/run_solver.h"
#include "core/image/sensors.h"
#include "core/io/sensors_csv.h"

namespace fluxwalk::cli {

namespace {

struct MeasureArguments {
    SceneArguments scene;
    SolverArguments solver;
    OutputArguments output;
    std::filesystem::path sensors;
    std::filesystem::path values;
};

ExitCode runMeasure(const MeasureArguments& arguments) {
    requireWritable(arguments.values);
    if (!arguments.output.report.empty()) {
        requireWritable(arguments.output.report);
    }
    const std::vector<scene::Sensor> sensors = io::readSensors(arguments.sensors);
    Solved solved = runSolver("measure", arguments.scene, arguments.solver, arguments.output);
    const std::vector<base::Rgb> irradiance = image::measure(*solved.solver, sensors);
    writeOutput([&] { io::writeSensors(arguments.values, sensors, irradiance); });
    completeReport(solved, {arguments.values.string()});
    deliver(solved.report, arguments.output);
    return solved.exitCode();
}

}  // namespace

Command measureCommand() {
    return {"measure", "Solve a scene and write the illuminance at sensors in lux.", [](CLI::App& app) {
                const auto arguments = std::make_shared<MeasureArguments>();
                // Sensors gather through the links: the mesh may be coarser than their values.
                arguments->solver.options.errorOf = solve::ErrorOf::gathered;
                addSceneOptions(app, arguments->scene);
                app.add_option("--sensors", arguments->sensors,
                               "Points and normals, on surfaces or in free space: a header and rows "
                               "x,y,z,nx,ny,nz (metres, y up).")
                    ->required()
                    ->type_name("IN.csv")
                    ->group("Scene");
                addSolverOptions(app, arguments->solver);
                app.add_option("-o,--output", arguments->values,
                               "The same rows with E_r,E_g,E_b and lux, in the same order.")
                    ->required()
                    ->type_name("OUT.csv")
                    ->group("Output");
                addOutputOptions(app, arguments->output);
                return [arguments] { return runMeasure(*arguments); };
            }};
}

}  // namespace fluxwalk::cli
