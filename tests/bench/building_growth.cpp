#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/file.h"
#include "core/scene/builders.h"
#include "tests/bench/cost.h"
#include "tests/bench/growth_plot.h"

// How the cost of an error grows with a building: with more rooms, with finer furniture in the same rooms,
// and, as contrast, with more rooms where every pair of patches is linked at first.
namespace fluxwalk::bench {
namespace {

struct Arguments {
    std::filesystem::path json =
        std::filesystem::path(FLUXWALK_SOURCE_DIR) / "build/bench/building-growth.json";
    std::filesystem::path plot =
        std::filesystem::path(FLUXWALK_SOURCE_DIR) / "build/bench/building-growth.svg";
    std::vector<std::size_t> polygons{10'000, 30'000, 100'000, 300'000};
    /// Of the series in which every pair of patches is linked: four times the links for twice the polygons.
    std::size_t mostForAllPairs = 10'000;
    unsigned rooms = 8;  ///< as many as the smallest building has
    double error = 0.1;
    unsigned threads = 0;
    double secondsLimit = 120.0;
    /// Of the reference: light of hundreds of lamps is noisy, so few sensors have many paths.
    std::size_t sensors = 256;
    std::uint64_t paths = 131'072;
};

struct Series {
    std::string name;
    solve::ClusterLinks clusterLinks{};
    bool hasMoreRooms = true;
};

struct Row {
    std::string scene;
    std::size_t polygons = 0;
    std::size_t patches = 0;
    double noise = 0.0;  ///< of the reference, part of the mean
    FirstSnapshot first;
    Cost cost;
    double lastError = 0.0;  ///< of the last level
    double lastSeconds = 0.0;
};

scene::Scene sceneOf(const std::string& name) {
    auto scene = scene::buildScene(name);
    if (!scene) {
        throw base::UsageError("no built-in scene is called '" + name + "'");
    }
    return std::move(*scene);
}

Row measureScene(const Arguments& arguments, const Series& series, const std::string& name,
                 std::size_t polygons) {
    const auto scene = std::make_shared<const scene::Scene>(sceneOf(name));
    SensorGroup everywhere{{}, arguments.sensors};
    for (std::uint32_t object = 0; object < scene->objects.size(); ++object) {
        everywhere.objects.push_back(object);
    }
    const Reference reference =
        traceReference(*scene, arguments.paths, arguments.threads, std::span(&everywhere, 1));
    const Setting setting{scene, &reference.points,      arguments.threads,
                          1,     arguments.secondsLimit, series.clusterLinks};
    Row row;
    row.scene = name;
    row.polygons = polygons;
    row.noise = noiseOf(reference.points).rms;
    row.patches = solve::Solver(scene, {}, arguments.threads).problem().hierarchy.patches().size();
    row.first = measureFirstSnapshot(setting);
    const std::vector<Level> levels = measureLevels(setting, solve::ErrorOf::gathered, arguments.error);
    row.cost = costAt(levels, {solve::ErrorOf::gathered, arguments.error});
    row.lastError = levels.back().errors.gathered.rms;
    row.lastSeconds = levels.back().duration.seconds;
    return row;
}

void printRow(const Row& row) {
    const Cost& c = row.cost;
    fmt::print("  {:<20} {:>8} {:>8.2f} ", row.scene, row.patches, row.first.duration.seconds);
    if (c.isReached) {
        fmt::print("{:>9.0f} {:>10.0f} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.0f}\n", c.leaves, c.links,
                   1e-6 * c.rays, c.seconds, c.cpuSeconds, 1e-6 * c.bytes);
    } else {
        fmt::print("not reached: {:.1f} % after {:.0f} s\n", 100.0 * row.lastError, row.lastSeconds);
    }
    std::fflush(stdout);
}

nlohmann::ordered_json toJson(const Series& series, const Row& row) {
    return {{"series", series.name},
            {"scene", row.scene},
            {"polygons", row.polygons},
            {"patches", row.patches},
            {"reference_noise", row.noise},
            {"first_snapshot_seconds", row.first.duration.seconds},
            {"first_snapshot_links", row.first.links},
            {"reached", row.cost.isReached},
            {"elements", row.cost.leaves},
            {"links", row.cost.links},
            {"rays", row.cost.rays},
            {"seconds", row.cost.seconds},
            {"cpu_seconds", row.cost.cpuSeconds},
            {"bytes", row.cost.bytes},
            {"last_error", row.lastError},
            {"last_seconds", row.lastSeconds}};
}

void measureGrowth(const Arguments& arguments) {
    const std::vector<Series> all{{"more rooms", solve::ClusterLinks::on, true},
                                  {"finer furniture", solve::ClusterLinks::on, false},
                                  {"more rooms, all pairs", solve::ClusterLinks::off, true}};
    Plot links{fmt::format("Links to {:g} % gathered", 100.0 * arguments.error), "polygons", "links", {}};
    Plot seconds{fmt::format("Seconds to {:g} % gathered", 100.0 * arguments.error), "polygons", "s", {}};
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    fmt::print("  {:<20} {:>8} {:>8} {:>9} {:>10} {:>8} {:>8} {:>8} {:>8}\n", "", "patches", "first s",
               "elements", "links", "M rays", "seconds", "CPU s", "MB");
    for (const Series& series : all) {
        fmt::print("{}\n", series.name);
        PlotLine ofLinks{series.name, {}, {}};
        PlotLine ofSeconds{series.name, {}, {}};
        for (const std::size_t polygons : arguments.polygons) {
            if (series.clusterLinks == solve::ClusterLinks::off && polygons > arguments.mostForAllPairs) {
                continue;
            }
            const std::string name = series.hasMoreRooms
                                         ? fmt::format("building:{}", polygons)
                                         : fmt::format("building:{}:{}", polygons, arguments.rooms);
            const Row row = measureScene(arguments, series, name, polygons);
            printRow(row);
            json.push_back(toJson(series, row));
            if (row.cost.isReached) {
                ofLinks.x.push_back(static_cast<double>(polygons));
                ofLinks.y.push_back(row.cost.links);
                ofSeconds.x.push_back(static_cast<double>(polygons));
                ofSeconds.y.push_back(row.cost.seconds);
            }
        }
        fmt::print("  grow as polygons^{:.2f} (links), ^{:.2f} (seconds)\n", fitExponent(ofLinks),
                   fitExponent(ofSeconds));
        links.lines.push_back(std::move(ofLinks));
        seconds.lines.push_back(std::move(ofSeconds));
    }
    for (const std::filesystem::path& file : {arguments.json, arguments.plot}) {
        if (file.has_parent_path()) {
            std::filesystem::create_directories(file.parent_path());
        }
    }
    io::writeFile(arguments.json, json.dump(2) + "\n");
    io::writeFile(arguments.plot, drawPlots({links, seconds}));
}

}  // namespace
}  // namespace fluxwalk::bench

int main(int argc, char** argv) {
    fluxwalk::bench::Arguments arguments;
    CLI::App app("Cost of an error against the size of a building, by more rooms and by finer furniture.");
    app.option_defaults()->always_capture_default();
    app.add_option("--polygons", arguments.polygons, "Sizes of the buildings");
    app.add_option("--rooms", arguments.rooms, "Rooms of the series with finer furniture")
        ->check(CLI::PositiveNumber);
    app.add_option("--all-pairs", arguments.mostForAllPairs, "Largest building whose patches are all linked");
    app.add_option("--error", arguments.error, "RMS error of gathered illuminance, part of the mean")
        ->check(CLI::Range(1e-3, 1.0));
    app.add_option("--sensors", arguments.sensors, "Sensors of the reference")->check(CLI::Range(16, 1000));
    app.add_option("--paths", arguments.paths, "Paths of the reference for each sensor")
        ->check(CLI::Range(2, 100'000'000));
    app.add_option("--limit", arguments.secondsLimit, "Seconds that one run may take")
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", arguments.threads, "0: all");
    app.add_option("--json", arguments.json, "File for the numbers");
    app.add_option("--plot", arguments.plot, "File for the picture (SVG)");
    CLI11_PARSE(app, argc, argv);
    try {
        fluxwalk::bench::measureGrowth(arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "building_growth: {}\n", error.what());
        return 1;
    }
    return 0;
}
