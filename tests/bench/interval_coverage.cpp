#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/image/intervals.h"
#include "core/reference/path_tracer.h"
#include "core/scene/builders.h"
#include "core/solve/probes.h"
#include "core/solve/state.h"
#include "tests/support/curved_room.h"

// How many intervals of sensors hold the truth, and how wide they are: built-in scenes against the path
// tracer.
namespace fluxwalk {
namespace {

struct Arguments {
    std::vector<std::string> scenes{"cornell-box", "two-rooms", "blobs", "gallery", "building:10000"};
    std::size_t sensors = 400;
    std::uint64_t paths = 16384;
    double error = 0.02;
    std::string table;
};

std::shared_ptr<const scene::Scene> makeScene(const std::string& name) {
    return std::make_shared<const scene::Scene>(name == "curved-room" ? test::buildCurvedRoom()
                                                                      : *scene::buildScene(name));
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void cover(const std::string& name, const Arguments& arguments, std::ofstream& table) {
    solve::Options options;
    options.error = arguments.error;
    options.errorOf = solve::ErrorOf::gathered;
    solve::Solver solver(makeScene(name), options, 0);
    const auto begin = std::chrono::steady_clock::now();
    solver.solve({});
    const double solving = secondsSince(begin);
    const solve::Problem& problem = solver.problem();
    std::vector<scene::Sensor> sensors;
    for (const solve::Probe& probe : solve::drawProbes(problem, arguments.sensors, 77)) {
        sensors.push_back({probe.position, probe.normal});
    }
    const auto start = std::chrono::steady_clock::now();
    const std::vector<image::Measurement> measured = image::measureIntervals(solver, sensors);
    const double seconds = secondsSince(start);
    reference::IrradianceTracer tracer(*problem.scene, problem.rays, problem.executor, sensors, 3);
    tracer.add(arguments.paths);
    const std::vector<reference::Estimate> truth = tracer.irradiance();
    std::size_t held = 0;
    std::size_t count = 0;
    std::vector<double> widths;
    double squares = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const image::Measurement& m = measured[i];
        if (m.place == image::SensorPlace::solid) {
            continue;
        }
        ++count;
        const double slack = 2.5758 * truth[i].luminanceError;
        held += truth[i].luminance + slack >= m.low && truth[i].luminance - slack <= m.high ? 1u : 0u;
        widths.push_back((m.high - m.low) / std::max(m.illuminance, 1e-9));
        const double off = m.illuminance - truth[i].luminance;
        squares += off * off;
        sum += truth[i].luminance;
        table << fmt::format(
            "{},{},{:.7g},{:.7g},{:.4g},{:.4g},{:.4g},{:.4g},{:.7g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}"
            "\n",
            name, i, m.illuminance, m.low, m.high, m.parts.shadows, m.parts.range, m.parts.kernel,
            truth[i].luminance, truth[i].luminanceError, m.parts.solution, sensors[i].position.x,
            sensors[i].position.y, m.parts.gaps, m.parts.defect);
    }
    std::sort(widths.begin(), widths.end());
    const auto n = static_cast<double>(count);
    fmt::print(
        "{:16} held {:6.2f} %, width median {:6.2f} %, 95th {:7.2f} %, RMS {:5.2f} % of mean; solved {:.1f} "
        "s, "
        "measured {:.2f} s, estimated error {:.2f} %\n",
        name, 100.0 * static_cast<double>(held) / n, 100.0 * widths[widths.size() / 2],
        100.0 * widths[widths.size() * 95 / 100], 100.0 * std::sqrt(squares / n) / (sum / n), solving,
        seconds, 100.0 * solver.statistics().estimatedError);
    std::fflush(stdout);
}

}  // namespace
}  // namespace fluxwalk

int main(int argc, char** argv) {
    fluxwalk::Arguments arguments;
    CLI::App app("Coverage and width of the intervals of sensors.");
    app.add_option("SCENES", arguments.scenes, "Built-in scenes, or curved-room.");
    app.add_option("--sensors", arguments.sensors, "Sensors for each scene.");
    app.add_option("--paths", arguments.paths, "Paths of the reference for each sensor; a multiple of 64.");
    app.add_option("--error", arguments.error, "Requested error of the solve, as a part of 1.");
    app.add_option("--table", arguments.table, "CSV of all sensors.");
    CLI11_PARSE(app, argc, argv);
    std::ofstream table(arguments.table);
    table << "scene,sensor,lux,low,high,shadows,range,kernel,reference,se,solution,x,y,gaps,defect\n";
    for (const std::string& name : arguments.scenes) {
        fluxwalk::cover(name, arguments, table);
    }
    return 0;
}
