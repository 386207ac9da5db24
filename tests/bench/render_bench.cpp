// Stills by final gathering: time, rays and error against path-traced references of the same pixels.
#include <chrono>
#include <fstream>
#include <numeric>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/still_errors.h"

namespace {

using namespace fluxwalk;
using Clock = std::chrono::steady_clock;

struct Case {
    std::string scene;
    std::string camera;
    std::uint32_t step = 24;
};

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

nlohmann::ordered_json run(const Case& one, double error, unsigned rays, unsigned strong, unsigned against,
                           std::uint32_t width, std::uint32_t height, std::uint64_t paths, unsigned samples,
                           std::size_t worst) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(one.scene));
    solve::Options options;
    options.error = error;
    options.errorOf = solve::ErrorOf::gathered;
    auto start = Clock::now();
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    const double solving = secondsSince(start);
    const auto camera = std::find_if(scene->cameras.begin(), scene->cameras.end(),
                                     [&](const scene::Camera& c) { return c.name == one.camera; });
    image::StillOptions still;
    still.width = width;
    still.height = height;
    still.rays.weak = rays;
    still.rays.strong = still.rays.sky = strong > 0 ? strong : rays + rays / 3;
    still.samples = samples;
    start = Clock::now();
    const image::Still picture = image::takeStill(solver.problem(), *camera, still);
    const double gathering = secondsSince(start);
    still.samples = 1;
    const image::Still plain = samples == 1 ? picture : image::takeStill(solver.problem(), *camera, still);
    if (against > 0) {
        image::StillOptions many = still;
        many.rays = {against, against, against};
        const image::Still smooth = image::takeStill(solver.problem(), *camera, many);
        double squares = 0.0;
        double mean = 0.0;
        for (std::size_t i = 0; i < plain.luminance.size(); ++i) {
            if (plain.object[i / 3] == smooth.object[i / 3] && plain.irradiance[i] > 0.0f) {
                // Reflected light only: what emits would hide the noise.
                const float part = glm::unpackHalf1x16(plain.albedo[i]);
                squares +=
                    std::pow(static_cast<double>(part * (plain.irradiance[i] - smooth.irradiance[i])), 2.0);
                mean += static_cast<double>(part * smooth.irradiance[i]);
            }
        }
        const auto n = static_cast<double>(plain.luminance.size());
        fmt::print("  noise {:.2f} % against {} rays\n", 100.0 * std::sqrt(squares / n) / (mean / n),
                   against);
    }
    const test::StillPoints points = test::findStillPoints(solver.problem(), *camera, still, one.step);
    start = Clock::now();
    const test::StillErrors errors = test::compareStill(solver.problem(), plain, points, paths);
    const double tracing = secondsSince(start);
    const double raysEach = static_cast<double>(picture.rays) / static_cast<double>(picture.gathers);
    // Error of the path tracer falls with the root of its time: what it would take to be as exact at all
    // pixels.
    const double ratio = errors.standardError / errors.error;
    const double pixels = static_cast<double>(width) * height;
    const double tracer = tracing * one.step * one.step * ratio * ratio;
    fmt::print(
        "{:14} {:10} solve {:6.2f} s  gather {:6.2f} s  {:5.1f} rays a point, {:.2f} points a pixel  "
        "error {:.2f} %  bias {:+.2f} %  (reference +- {:.2f} %)  path tracer to the same {:.0f} s\n",
        one.scene, one.camera, solving, gathering, raysEach, static_cast<double>(picture.gathers) / pixels,
        100.0 * errors.error, 100.0 * errors.bias, 100.0 * errors.standardError, tracer);
    std::vector<std::size_t> order(points.sensors.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(errors.differences[a]) > std::abs(errors.differences[b]);
    });
    for (std::size_t i = 0; i < std::min(worst, order.size()); ++i) {
        const scene::Sensor& s = points.sensors[order[i]];
        fmt::print(
            "  {:+.3f} of {:.3f} cd/m2 at {:.4f},{:.4f},{:.4f} normal {:.2f},{:.2f},{:.2f} pixel {},{}\n",
            errors.differences[order[i]], errors.truths[order[i]], s.position.x, s.position.y, s.position.z,
            s.normal.x, s.normal.y, s.normal.z, points.pixels[order[i]] % width,
            points.pixels[order[i]] / width);
    }
    return {{"scene", one.scene},
            {"camera", one.camera},
            {"width", width},
            {"height", height},
            {"solveSeconds", solving},
            {"gatherSeconds", gathering},
            {"raysPerPoint", raysEach},
            {"error", errors.error},
            {"bias", errors.bias},
            {"referenceError", errors.standardError},
            {"pathTracerSeconds", tracer}};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Stills by final gathering against the path tracer.");
    std::vector<std::string> scenes;
    double error = 0.03;
    unsigned rays = image::GatherRays{}.weak;
    unsigned strong = 0;
    unsigned against = 0;
    unsigned samples = 8;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint64_t paths = 2048;
    std::size_t worst = 0;
    std::string json;
    app.add_option("--scene", scenes, "Only these.");
    app.add_option("--error", error, "Of the solution.");
    app.add_option("--shadow-rays", rays, "As in render.");
    app.add_option("--lamp-rays", strong, "Shadow rays to a strong source; by default a third more.");
    app.add_option("--noise-against", against, "Also the noise, against as many rays to each source.");
    app.add_option("--samples", samples, "As in render.");
    app.add_option("--width", width);
    app.add_option("--height", height);
    app.add_option("--paths", paths, "For each point of the reference.");
    app.add_option("--worst", worst, "Points to list, those with the largest errors.");
    app.add_option("--json", json, "Results as a file.");
    CLI11_PARSE(app, argc, argv);
    const std::vector<Case> cases{
        {"cornell-box", "front"}, {"gallery", "entrance"}, {"gallery", "vases"}, {"building:10000", "room"}};
    nlohmann::ordered_json results = nlohmann::json::array();
    for (const Case& one : cases) {
        if (scenes.empty() || std::find(scenes.begin(), scenes.end(), one.scene) != scenes.end()) {
            results.push_back(run(one, error, rays, strong, against, width, height, paths, samples, worst));
        }
    }
    if (!json.empty()) {
        std::ofstream(json) << results.dump(2) << "\n";
    }
    return 0;
}
