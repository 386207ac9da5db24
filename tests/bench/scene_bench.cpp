#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/file.h"
#include "core/scene/builders.h"
#include "tests/bench/scene_report.h"

// Time to error of a built-in scene against a reference that was traced once. Prints a table and writes the
// same numbers as JSON.
namespace fluxwalk::bench {
namespace {

struct Arguments {
    std::string scene = "cornell-box";
    std::filesystem::path reference;
    std::filesystem::path json;
    unsigned threads = 0;
    unsigned repeats = 3;
    double secondsLimit = 15.0;
    std::string referenceOf;
    std::uint64_t paths = 200'000;
};

// Scenes with numbers in their names have a colon, which not all file systems take.
std::string fileNameOf(std::string scene) {
    std::replace(scene.begin(), scene.end(), ':', '-');
    return scene;
}

std::filesystem::path defaultReference(const std::string& scene) {
    return std::filesystem::path(FLUXWALK_SOURCE_DIR) / "tests/bench/reference" /
           (fileNameOf(scene) + ".csv");
}

scene::Scene sceneOf(const std::string& name) {
    auto scene = scene::buildScene(name);
    if (!scene) {
        throw base::UsageError("no built-in scene is called '" + name + "'");
    }
    return std::move(*scene);
}

void makeReference(const Arguments& arguments) {
    const std::filesystem::path file =
        arguments.reference.empty() ? defaultReference(arguments.referenceOf) : arguments.reference;
    const Reference reference =
        traceReference(sceneOf(arguments.referenceOf), arguments.paths, arguments.threads);
    writeReference(file, reference);
    const double mean = meanIrradiance(reference.points);
    fmt::print(
        "{}: {} sensors ({} of those drawn lie under solids), mean {:.3f} lux, standard error {:.3f} % of "
        "it\n",
        file.string(), reference.points.size(), reference.hiddenCount, mean,
        100.0 * std::sqrt(noiseSquare(reference.points)) / mean);
}

double loadOfMachine() {
    double load = 0.0;
    return getloadavg(&load, 1) == 1 ? load : 0.0;
}

void runScene(const Arguments& arguments) {
    using solve::ErrorOf;
    SceneReport report;
    report.scene = arguments.scene;
    report.threads = base::Executor(arguments.threads).threadCount();
    report.repeats = arguments.repeats;
    report.load = loadOfMachine();
    const Reference reference =
        readReference(arguments.reference.empty() ? defaultReference(arguments.scene) : arguments.reference);
    report.sensorCount = reference.points.size();
    report.hiddenCount = reference.hiddenCount;
    report.meanIrradiance = meanIrradiance(reference.points);
    report.noise = noiseOf(reference.points);

    const Setting setting{std::make_shared<const scene::Scene>(sceneOf(arguments.scene)), &reference.points,
                          arguments.threads, arguments.repeats, arguments.secondsLimit};
    report.first = measureFirstSnapshot(setting);
    report.gatheredLevels = measureLevels(setting, ErrorOf::gathered, 0.005);
    report.displayedLevels = measureLevels(setting, ErrorOf::displayed, 0.02);
    for (const double error : {0.02, 0.01, 0.005}) {
        report.loops.push_back(measureClosedLoop(setting, ErrorOf::gathered, error));
    }
    for (const double error : {0.05, 0.02}) {
        report.loops.push_back(measureClosedLoop(setting, ErrorOf::displayed, error));
    }
    solve::Options options;
    options.errorOf = ErrorOf::gathered;
    options.error = 0.01;
    solve::Solver solver(setting.scene, options, arguments.threads);
    solver.solve({});
    report.costs = measureTransportCosts(solver.problem());

    const Targets targets;
    std::fputs(formatReport(report, targets).c_str(), stdout);
    const std::filesystem::path json = arguments.json.empty()
                                           ? std::filesystem::path(FLUXWALK_SOURCE_DIR) / "build/bench" /
                                                 (fileNameOf(arguments.scene) + ".json")
                                           : arguments.json;
    if (json.has_parent_path()) {
        std::filesystem::create_directories(json.parent_path());
    }
    io::writeFile(json, toJson(report, targets).dump(2) + "\n");
}

}  // namespace
}  // namespace fluxwalk::bench

int main(int argc, char** argv) {
    fluxwalk::bench::Arguments arguments;
    CLI::App app("Time to error of a built-in scene, against a reference beside this program's source.");
    app.option_defaults()->always_capture_default();
    app.add_option("--scene", arguments.scene, "Name of a built-in scene");
    app.add_option("--reference", arguments.reference,
                   "Table of the true values (default: tests/bench/reference/SCENE.csv)");
    app.add_option("--json", arguments.json, "File for the numbers (default: build/bench/SCENE.json)");
    app.add_option("--threads", arguments.threads, "0: all");
    app.add_option("--repeat", arguments.repeats, "Runs of each case; the fastest counts")
        ->check(CLI::Range(1, 100));
    app.add_option("--limit", arguments.secondsLimit, "Seconds that one run may take")
        ->check(CLI::PositiveNumber);
    app.add_option("--make-reference", arguments.referenceOf, "Trace the reference of this scene instead");
    app.add_option("--paths", arguments.paths, "Paths of the reference for each sensor")
        ->check(CLI::Range(2, 100'000'000));
    CLI11_PARSE(app, argc, argv);
    try {
        if (arguments.referenceOf.empty()) {
            fluxwalk::bench::runScene(arguments);
        } else {
            fluxwalk::bench::makeReference(arguments);
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "scene_bench: {}\n", error.what());
        return 1;
    }
    return 0;
}
