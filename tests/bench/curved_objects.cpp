#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/io/file.h"
#include "tests/bench/cost.h"
#include "tests/support/curved_room.h"
#include "tests/support/tessellate.h"

// What exact objects save: a room of curved objects solved as they are, and cut into flat facets by the
// coarsest uniform tessellation with which the same error is reached at the same sensors.
namespace fluxwalk::bench {
namespace {

struct Arguments {
    std::filesystem::path reference =
        std::filesystem::path(FLUXWALK_SOURCE_DIR) / "tests/bench/reference/curved-room.csv";
    std::filesystem::path json = std::filesystem::path(FLUXWALK_SOURCE_DIR) / "build/bench/curved-room.json";
    unsigned threads = 0;
    double secondsLimit = 8.0;
    bool makesReference = false;
    bool takesClusters = false;
    std::uint64_t paths = 100'000;
};

constexpr std::array<ErrorTarget, 4> kTargets{{{solve::ErrorOf::gathered, 0.07},
                                               {solve::ErrorOf::gathered, 0.03},
                                               {solve::ErrorOf::displayed, 0.08},
                                               {solve::ErrorOf::displayed, 0.05}}};
/// Segments along each side of a curved patch. Links start between all pairs of patches: with more, those
/// alone take minutes.
constexpr std::array<std::uint32_t, 4> kSegments{1, 2, 3, 4};

bool isCurved(const surface::Surface& surface) {
    return !surface.isPlanar(0);
}

/// A scene that is solved, and the reference at its own surfaces.
struct Variant {
    std::uint32_t segments = 0;  ///< 0: exact
    std::shared_ptr<const scene::Scene> scene;
    std::vector<ReferencePoint> reference;
    std::size_t patches = 0;  ///< with light on them, each side counted
};

// Cuts the curved objects, and moves the sensors on them to the facets that stand for their places.
Variant tessellateScene(const scene::Scene& exact, const std::vector<ReferencePoint>& reference,
                        const std::vector<Site>& sites, std::uint32_t segments) {
    scene::Scene flat = exact;
    std::vector<std::optional<test::Tessellation>> tessellations(exact.objects.size());
    for (std::size_t i = 0; i < exact.objects.size(); ++i) {
        if (isCurved(*exact.objects[i].surface)) {
            tessellations[i].emplace(*exact.objects[i].surface, segments);
            flat.objects[i].surface = tessellations[i]->mesh();
        }
    }
    Variant variant{segments, nullptr, reference, 0};
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const Site& site = sites[i];
        if (tessellations[site.object]) {
            const test::Tessellation& t = *tessellations[site.object];
            const test::Tessellation::Place place = t.find(site.patch, site.uv);
            const surface::SurfacePoint p = t.mesh()->evaluate(place.patch, place.uv);
            variant.reference[i].sensor = {p.position, site.back ? -p.normal : p.normal};
        }
    }
    variant.scene = std::make_shared<const scene::Scene>(std::move(flat));
    return variant;
}

/// What a variant costs where its error passes the target.
struct VariantCost : Cost {
    std::uint32_t segments = 0;
    std::size_t patches = 0;
};

VariantCost costOf(const Variant& variant, std::span<const Level> levels, const ErrorTarget& target) {
    return {costAt(levels, target), variant.segments, variant.patches};
}

std::vector<Level> solveVariant(const Arguments& arguments, const Variant& variant) {
    const Setting setting{
        variant.scene,          &variant.reference,
        arguments.threads,      1,
        arguments.secondsLimit, arguments.takesClusters ? solve::ClusterLinks::on : solve::ClusterLinks::off};
    constexpr double kGathered = 0.03;
    constexpr double kDisplayed = 0.05;
    std::vector<Level> levels = measureLevels(setting, solve::ErrorOf::gathered, kGathered);
    const bool isInTime = firstBelow(levels, solve::ErrorOf::gathered, kGathered) != nullptr;
    if (isInTime && firstBelow(levels, solve::ErrorOf::displayed, kDisplayed) == nullptr) {
        levels = measureLevels(setting, solve::ErrorOf::displayed, kDisplayed);
    }
    return levels;
}

std::size_t countPatches(const Variant& variant, unsigned threads) {
    const solve::Solver solver(variant.scene, {}, threads);
    return solver.problem().hierarchy.patches().size();
}

std::string formatRow(const char* name, const VariantCost& c) {
    if (!c.isReached) {
        return fmt::format("  {:<12} not reached\n", name);
    }
    const std::string cut = c.segments == 0 ? "" : fmt::format("{0} x {0}", c.segments);
    return fmt::format("  {:<12} {:>7} {:>8} {:>9.0f} {:>9.0f} {:>8.2f} {:>8.2f} {:>8.1f}\n", name, cut,
                       c.patches, c.leaves, c.links, 1e-6 * c.rays, c.seconds, 1e-6 * c.bytes);
}

nlohmann::ordered_json toJson(const VariantCost& c) {
    return {{"reached", c.isReached}, {"segments", c.segments}, {"patches", c.patches},
            {"elements", c.leaves},   {"links", c.links},       {"rays", c.rays},
            {"seconds", c.seconds},   {"bytes", c.bytes}};
}

void compareVariants(const Arguments& arguments) {
    const Reference reference = readReference(arguments.reference);
    Variant exact{0, std::make_shared<const scene::Scene>(test::buildCurvedRoom()), reference.points, 0};
    std::vector<Site> sites;
    {
        const base::Executor executor(arguments.threads);
        const rays::RayScene rays(*exact.scene, executor);
        sites = findSites(*exact.scene, rays, reference.points);
    }
    exact.patches = countPatches(exact, arguments.threads);
    const std::vector<Level> levels = solveVariant(arguments, exact);
    std::array<VariantCost, kTargets.size()> asIs;
    std::array<VariantCost, kTargets.size()> asFacets;
    for (std::size_t t = 0; t < kTargets.size(); ++t) {
        asIs[t] = costOf(exact, levels, kTargets[t]);
    }
    for (const std::uint32_t segments : kSegments) {
        if (std::all_of(asFacets.begin(), asFacets.end(), [](const VariantCost& c) { return c.isReached; })) {
            break;
        }
        Variant flat = tessellateScene(*exact.scene, reference.points, sites, segments);
        flat.patches = countPatches(flat, arguments.threads);
        const std::vector<Level> flatLevels = solveVariant(arguments, flat);
        const auto least = [&](solve::ErrorOf what) {
            double error = 1.0;
            for (const Level& level : flatLevels) {
                error = std::min(error, level.errors.of(what));
            }
            return 100.0 * error;
        };
        fmt::print(
            "{0} x {0} facets a patch: {1} patches, least error {2:.2f} % gathered, {3:.2f} % displayed, "
            "{4:.1f} s\n",
            segments, flat.patches, least(solve::ErrorOf::gathered), least(solve::ErrorOf::displayed),
            flatLevels.back().duration.seconds);
        std::fflush(stdout);
        for (std::size_t t = 0; t < kTargets.size(); ++t) {
            if (!asFacets[t].isReached) {
                asFacets[t] = costOf(flat, flatLevels, kTargets[t]);
            }
        }
    }
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    fmt::print("{:<14} {:>7} {:>8} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "facets", "patches", "elements",
               "links", "M rays", "seconds", "MB");
    for (std::size_t t = 0; t < kTargets.size(); ++t) {
        const char* what = kTargets[t].what == solve::ErrorOf::gathered ? "gathered" : "displayed";
        fmt::print("{:g} % {}\n{}{}", 100.0 * kTargets[t].error, what, formatRow("exact", asIs[t]),
                   formatRow("tessellated", asFacets[t]));
        json.push_back({{"error", kTargets[t].error},
                        {"of", what},
                        {"exact", toJson(asIs[t])},
                        {"tessellated", toJson(asFacets[t])}});
    }
    if (arguments.json.has_parent_path()) {
        std::filesystem::create_directories(arguments.json.parent_path());
    }
    io::writeFile(arguments.json, json.dump(2) + "\n");
}

void makeReference(const Arguments& arguments) {
    const scene::Scene scene = test::buildCurvedRoom();
    // One half of the sensors on what surrounds the curved objects, the other on these.
    std::array<SensorGroup, 2> groups;
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
        groups[isCurved(*scene.objects[object].surface) ? 1 : 0].objects.push_back(object);
    }
    groups[0].count = groups[1].count = 500;
    const Reference reference = traceReference(scene, arguments.paths, arguments.threads, groups);
    writeReference(arguments.reference, reference);
    fmt::print("{}: {} sensors, mean {:.3f} lux, standard error {:.3f} % of it\n",
               arguments.reference.string(), reference.points.size(), meanIrradiance(reference.points),
               100.0 * noiseOf(reference.points).rms);
}

}  // namespace
}  // namespace fluxwalk::bench

int main(int argc, char** argv) {
    fluxwalk::bench::Arguments arguments;
    CLI::App app("Curved objects solved exactly, and as flat facets, to the same error.");
    app.option_defaults()->always_capture_default();
    app.add_option("--reference", arguments.reference, "Table of the true values");
    app.add_option("--json", arguments.json, "File for the numbers");
    app.add_option("--threads", arguments.threads, "0: all");
    app.add_flag("--clusters", arguments.takesClusters, "Links may end at clusters, in both");
    app.add_option("--limit", arguments.secondsLimit, "Seconds that one run may take")
        ->check(CLI::PositiveNumber);
    app.add_flag("--make-reference", arguments.makesReference, "Trace the reference instead");
    app.add_option("--paths", arguments.paths, "Paths of the reference for each sensor")
        ->check(CLI::Range(2, 100'000'000));
    CLI11_PARSE(app, argc, argv);
    try {
        (arguments.makesReference ? fluxwalk::bench::makeReference
                                  : fluxwalk::bench::compareVariants)(arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "curved_objects: {}\n", error.what());
        return 1;
    }
    return 0;
}
