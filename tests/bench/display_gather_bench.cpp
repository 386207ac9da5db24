// Display meshes with gathered light: time until all that a camera sees is there, points a second, memory.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/image/display_gather.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"

namespace {

using namespace fluxwalk;
using Clock = std::chrono::steady_clock;

struct Case {
    std::string scene;
    std::string camera;
};

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t countVertices(const scene::LitMeshes& meshes) {
    std::size_t count = 0;
    for (const auto& mesh : meshes) {
        count += mesh->positions.size();
    }
    return count;
}

void run(const Case& one, double error, unsigned threads, bool isSeenOnly,
         const image::DisplayGatherOptions& options) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(one.scene));
    solve::Options solveOptions;
    solveOptions.error = error;
    auto start = Clock::now();
    solve::Solver solver(scene, solveOptions, threads);
    solver.solve({});
    const double solving = secondsSince(start);
    const std::size_t before = countVertices(solver.litMeshes());
    const auto camera = std::find_if(scene->cameras.begin(), scene->cameras.end(),
                                     [&](const scene::Camera& c) { return c.name == one.camera; });
    const image::Look look{*camera, 16.0 / 9.0};
    const std::uint64_t memory = base::residentMemory();
    start = Clock::now();
    image::DisplayGather gather(solver.problem(), options);
    gather.work(look, Clock::now());
    const double arranging = secondsSince(start);
    while (gather.seenPending() > 0) {
        gather.work(look, Clock::now() + std::chrono::milliseconds(100));
    }
    const double seen = secondsSince(start);
    const std::size_t seenLeaves = gather.doneCount();
    start = Clock::now();
    gather.meshes(0.0698);
    const double building = secondsSince(start);
    start = Clock::now();
    while (!isSeenOnly && !gather.isDone()) {
        gather.work(look, Clock::now() + std::chrono::milliseconds(500));
    }
    const double all = seen + secondsSince(start);
    start = Clock::now();
    const std::size_t after = countVertices(gather.meshes(0.0698));
    const double buildingAll = secondsSince(start);
    fmt::print(
        "{:14} {:9} solve {:.2f} s  look {:.3f} s  seen {} leaves in {:.2f} s  all {} in {:.2f} s  {:.0f} "
        "points/s  {:.1f} points a leaf  meshes {:.2f} s, {:.2f} s  vertices {} -> {}  light {:.1f} MB, "
        "process +{:.1f} MB\n",
        one.scene, one.camera, solving, arranging, seenLeaves, seen, gather.leafCount(), all,
        static_cast<double>(gather.pointCount()) / all,
        static_cast<double>(gather.pointCount()) /
            static_cast<double>(std::max<std::size_t>(1, gather.doneCount())),
        building, buildingAll, before, after, static_cast<double>(gather.bytes()) / 1e6,
        (static_cast<double>(base::residentMemory()) - static_cast<double>(memory)) / 1e6);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Gathered light at display vertices.");
    std::vector<std::string> scenes;
    double error = solve::Options{}.error;
    unsigned threads = 0;
    bool isSeenOnly = false;
    image::DisplayGatherOptions options;
    app.add_option("--scene", scenes, "Only these.");
    app.add_option("--error", error, "Of the solution.");
    app.add_option("--threads", threads);
    app.add_option("--lamp-rays", options.rays.strong);
    app.add_option("--shadow-rays", options.rays.weak);
    app.add_option("--levels", options.sharpness.mostLevels);
    app.add_option("--bend", options.sharpness.bend);
    app.add_option("--range", options.sharpness.range);
    app.add_option("--side", options.sharpness.leastSide);
    app.add_flag("--seen-only", isSeenOnly, "Not what the camera does not see.");
    CLI11_PARSE(app, argc, argv);
    const std::vector<Case> cases{
        {"cornell-box", "front"}, {"gallery", "entrance"}, {"gallery", "vases"}, {"building:10000", "room"}};
    for (const Case& one : cases) {
        if (scenes.empty() || std::find(scenes.begin(), scenes.end(), one.scene) != scenes.end()) {
            run(one, error, threads, isSeenOnly, options);
        }
    }
    return 0;
}
