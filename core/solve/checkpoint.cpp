#include "core/solve/checkpoint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/base/hash.h"
#include "core/scene/scene_hash.h"
#include "core/solve/checkpoint_nodes.h"
#include "core/solve/options_table.h"

namespace fluxwalk::solve {

namespace {

constexpr const char* kKind = "fluxwalk checkpoint";
/// Changes with the arrays and with whatever alters the bits of a solve.
constexpr std::uint32_t kVersion = 5;
constexpr std::size_t kMaxHistory = 100'000;
constexpr std::uint32_t kMostSweeps = 1000;

using Counter = std::pair<const char*, std::uint64_t Counters::*>;
constexpr std::array kCounters = {
    Counter{"counters/nodes", &Counters::nodes},
    Counter{"counters/leaves", &Counters::leaves},
    Counter{"counters/links", &Counters::links},
    Counter{"counters/waves", &Counters::waves},
    Counter{"counters/sweeps", &Counters::sweeps},
    Counter{"counters/rays", &Counters::rays},
    Counter{"counters/kernel-evaluations", &Counters::kernelEvaluations},
    Counter{"counters/certificates", &Counters::certificates},
    Counter{"counters/bytes-nodes", &Counters::bytesNodes},
    Counter{"counters/bytes-links", &Counters::bytesLinks},
    Counter{"counters/bytes-counted", &Counters::bytesCounted},
};

using Time = std::pair<const char*, double StageTimes::*>;
constexpr std::array kTimes = {
    Time{"times/build", &StageTimes::build},     Time{"times/refine", &StageTimes::refine},
    Time{"times/sweep", &StageTimes::sweep},     Time{"times/audit", &StageTimes::audit},
    Time{"times/display", &StageTimes::display}, Time{"times/total", &StageTimes::total},
};

struct Level {
    const char* name;
    const char* unit;
    double Statistics::*value;
};
constexpr std::array kLevel = {
    Level{"level/threshold", "lux", &Statistics::threshold},
    Level{"level/largest-error", "lux", &Statistics::largestError},
    Level{"level/residual", "", &Statistics::residual},
    Level{"level/estimated-error", "", &Statistics::estimatedError},
    Level{"level/mean-irradiance", "lux", &Statistics::meanIrradiance},
};

struct Past {
    const char* name;
    const char* unit;
    double HistoryEntry::*value;
};
constexpr std::array kPast = {
    Past{"history/seconds", "s", &HistoryEntry::seconds},
    Past{"history/threshold", "lux", &HistoryEntry::threshold},
    Past{"history/residual", "", &HistoryEntry::residual},
    Past{"history/error", "", &HistoryEntry::error},
};
constexpr const char* kPastLinks = "history/links";
/// Limits of a machine or an evening are no part of a state.
constexpr std::array<std::string_view, 2> kOwn = {"time-limit", "memory-limit"};
/// Nor is how it is shown.
constexpr std::string_view kShown = "display";

template <class T>
void addValue(base::NamedArrays& arrays, std::string name, T value, std::string unit = {}) {
    arrays.arrays.push_back({std::move(name), std::vector<T>{value}, 1, std::move(unit)});
}

void saveOptions(base::NamedArrays& arrays, const Options& options) {
    for (const OptionInfo& option : optionsTable()) {
        if (option.name == kShown) {
            continue;
        }
        addValue(arrays, "options/" + std::string(option.name), option.get(options),
                 option.kind == OptionKind::fraction ? "" : std::string(option.unit));
    }
}

void addColors(base::NamedArrays& arrays, std::string name, const std::vector<Rgb>& colors) {
    std::vector<float> values;
    values.reserve(3 * colors.size());
    for (const Rgb& color : colors) {
        values.insert(values.end(), {color.r, color.g, color.b});
    }
    arrays.arrays.push_back({std::move(name), std::move(values), 3});
}

// Every material and light of the scene, so that a list of another length is none of this scene.
void saveLighting(base::NamedArrays& arrays, const scene::Scene& scene, scene::Lighting lighting) {
    lighting.materials.resize(scene.materials.size(), Rgb(1.0f));
    lighting.lights.resize(scene.lights.size(), Rgb(1.0f));
    addColors(arrays, "lighting/materials", lighting.materials);
    addColors(arrays, "lighting/lights", lighting.lights);
    addColors(arrays, "lighting/sky", {lighting.sky});
}

std::vector<Rgb> readFactors(const base::ArrayReader& reader, const char* name) {
    const std::vector<float>& values = reader.values<float>(name, 3);
    std::vector<Rgb> factors;
    for (std::size_t i = 0; i < values.size(); i += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(values[i + c] >= 0.0f && values[i + c] <= scene::kLargestLightFactor)) {
                reader.fail(name, "is out of its range");
            }
        }
        factors.emplace_back(values[i], values[i + 1], values[i + 2]);
    }
    return factors;
}

scene::Lighting readLighting(const base::ArrayReader& reader) {
    scene::Lighting lighting;
    lighting.materials = readFactors(reader, "lighting/materials");
    lighting.lights = readFactors(reader, "lighting/lights");
    const std::vector<Rgb> sky = readFactors(reader, "lighting/sky");
    if (sky.size() != 1) {
        reader.fail("lighting/sky", "is no colour");
    }
    lighting.sky = sky.front();
    return lighting;
}

void saveStatistics(base::NamedArrays& arrays, const Statistics& statistics) {
    for (const auto& [name, member] : kCounters) {
        addValue(arrays, name, statistics.counters.*member);
    }
    for (const auto& [name, member] : kTimes) {
        addValue(arrays, name, statistics.times.*member, "s");
    }
    for (const Level& level : kLevel) {
        addValue(arrays, level.name, statistics.*level.value, level.unit);
    }
    for (const Past& past : kPast) {
        std::vector<double> values;
        for (const HistoryEntry& entry : statistics.history) {
            values.push_back(entry.*past.value);
        }
        arrays.arrays.push_back({past.name, std::move(values), 1, past.unit});
    }
    std::vector<std::uint64_t> links;
    for (const HistoryEntry& entry : statistics.history) {
        links.push_back(entry.links);
    }
    arrays.arrays.push_back({kPastLinks, std::move(links)});
}

double finite(const base::ArrayReader& reader, const std::string& name, double value) {
    if (!std::isfinite(value)) {
        reader.fail(name, "is not finite");
    }
    return value;
}

void restoreStatistics(Statistics& statistics, const base::ArrayReader& reader) {
    for (const auto& [name, member] : kCounters) {
        statistics.counters.*member = reader.value<std::uint64_t>(name);
    }
    for (const auto& [name, member] : kTimes) {
        statistics.times.*member = finite(reader, name, reader.value<double>(name));
    }
    for (const Level& level : kLevel) {
        statistics.*level.value = finite(reader, level.name, reader.value<double>(level.name));
    }
    const std::vector<std::uint64_t>& links = reader.values<std::uint64_t>(kPastLinks);
    if (links.size() > kMaxHistory) {
        reader.fail(kPastLinks, "is too long");
    }
    statistics.history.assign(links.size(), {});
    for (std::size_t i = 0; i < links.size(); ++i) {
        statistics.history[i].links = links[i];
    }
    for (const Past& past : kPast) {
        const std::vector<double>& values = reader.values<double>(past.name, 1, links.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            statistics.history[i].*past.value = finite(reader, past.name, values[i]);
        }
    }
}

void restoreStage(LoopState& loop, const base::ArrayReader& reader) {
    const auto stage = reader.value<std::uint8_t>("level/stage");
    const auto sweeps = reader.value<std::uint32_t>("level/sweeps");
    if (stage > static_cast<std::uint8_t>(Stage::follow) || sweeps > kMostSweeps) {
        reader.fail("level", "is no stage of a solve");
    }
    loop.stage = static_cast<Stage>(stage);
    loop.sweeps = static_cast<int>(sweeps);
    loop.isCoarsening = reader.value<std::uint8_t>("level/is-coarsening") != 0;
    const auto turn = reader.value<std::uint8_t>("level/turn");
    if (turn > static_cast<std::uint8_t>(Turn::anew)) {
        reader.fail("level/turn", "is none");
    }
    loop.asked = {static_cast<Turn>(turn),
                  finite(reader, "level/turn-threshold", reader.value<double>("level/turn-threshold"))};
}

void checkKind(const base::NamedArrays& arrays, const base::ArrayReader& reader) {
    if (arrays.kind != kKind) {
        reader.fail("", "is no checkpoint");
    }
    if (arrays.version != kVersion) {
        reader.fail("", "was written by another version: it holds checkpoint " +
                            std::to_string(arrays.version) + ", this program reads " +
                            std::to_string(kVersion));
    }
}

std::uint64_t sceneHash(const Problem& problem, LoopState& loop) {
    if (!loop.sceneHash) {
        loop.sceneHash = scene::hashScene(*problem.scene);
    }
    return *loop.sceneHash;
}

// What fixes the hierarchy before the first split cannot change any more.
void checkFixed(const Problem& problem, const Options& stored, const base::ArrayReader& reader) {
    const auto check = [&reader](bool isSame, const char* option) {
        if (!isSame) {
            reader.fail("", std::string("was solved with another --") + option);
        }
    };
    check(problem.options.seed == stored.seed, "seed");
    check(problem.options.clusters == stored.clusters, "clusters");
    check(problem.options.clusterModel == stored.clusterModel, "cluster-model");
    check(problem.options.visibilityRays == stored.visibilityRays, "visibility-rays");
    check(problem.options.rays == stored.rays, "rays");
}

}  // namespace

base::NamedArrays saveState(const Problem& problem, LoopState& loop) {
    base::NamedArrays arrays;
    arrays.kind = kKind;
    arrays.version = kVersion;
    addValue(arrays, "scene/hash", sceneHash(problem, loop));
    saveOptions(arrays, problem.options);
    saveLighting(arrays, *problem.scene, problem.hierarchy.lighting());
    saveStatistics(arrays, problem.statistics);
    addValue(arrays, "level/ambient", loop.ambient, "lux");
    addValue(arrays, "level/has-changed", static_cast<std::uint8_t>(loop.hasChanged ? 1 : 0));
    addValue(arrays, "level/stage", static_cast<std::uint8_t>(loop.stage));
    addValue(arrays, "level/sweeps", static_cast<std::uint32_t>(loop.sweeps));
    addValue(arrays, "level/turn", static_cast<std::uint8_t>(loop.asked.turn));
    addValue(arrays, "level/turn-threshold", loop.asked.threshold, "lux");
    addValue(arrays, "level/is-coarsening", static_cast<std::uint8_t>(loop.isCoarsening ? 1 : 0));
    std::vector<float> gathered;
    for (const Rgb& e : loop.gathered) {
        gathered.insert(gathered.end(), {e.r, e.g, e.b});
    }
    arrays.arrays.push_back({"probes/irradiance", std::move(gathered), 3, "lux"});
    saveNodes(arrays, problem.hierarchy);
    saveLinks(arrays, problem.links);
    savePending(arrays, problem.pending);
    return arrays;
}

void restoreState(Problem& problem, LoopState& loop, const base::NamedArrays& arrays,
                  const std::string& file) {
    const base::ArrayReader reader(arrays, file);
    checkKind(arrays, reader);
    if (reader.value<std::uint64_t>("scene/hash") != sceneHash(problem, loop)) {
        reader.fail("", "belongs to another scene than '" + problem.scene->name + "' as it is now");
    }
    const Options stored = storedOptions(arrays, problem.options, file);
    checkFixed(problem, stored, reader);
    if (stored.lighting.materials.size() != problem.scene->materials.size() ||
        stored.lighting.lights.size() != problem.scene->lights.size()) {
        reader.fail("lighting", "does not fit this scene");
    }
    problem.hierarchy.relight(stored.lighting, problem.executor);
    restoreNodes(problem, reader);
    restoreStage(loop, reader);
    restoreLinks(problem, reader, loop.stage != Stage::refine);
    restorePending(problem, reader);
    const double build = problem.statistics.times.build;
    restoreStatistics(problem.statistics, reader);
    problem.statistics.times.build += build;
    problem.rowScale.clear();

    if (!problem.pending.empty() && loop.stage != Stage::refine) {
        reader.fail("level/stage", "does not agree with the pairs that are pending");
    }
    loop.isStarted = true;
    loop.ambient = finite(reader, "level/ambient", reader.value<double>("level/ambient"));
    // Smaller elements may be allowed now.
    loop.hasChanged =
        reader.value<std::uint8_t>("level/has-changed") != 0 || problem.options.minArea != stored.minArea;
    loop.secondsBefore = problem.statistics.times.total;
    const std::vector<float>& gathered = reader.values<float>("probes/irradiance", 3);
    loop.gathered.clear();
    for (std::size_t i = 0; i < gathered.size(); i += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
            finite(reader, "probes/irradiance", static_cast<double>(gathered[i + c]));
        }
        loop.gathered.emplace_back(gathered[i], gathered[i + 1], gathered[i + 2]);
    }
}

Options storedOptions(const base::NamedArrays& arrays, const Options& others, const std::string& file) {
    const base::ArrayReader reader(arrays, file);
    checkKind(arrays, reader);
    Options options = others;
    for (const OptionInfo& option : optionsTable()) {
        if (option.name == kShown) {
            continue;
        }
        const std::string name = "options/" + std::string(option.name);
        const double value = reader.value<double>(name);
        const bool isWhole = option.kind == OptionKind::integer || option.kind == OptionKind::choice ||
                             option.kind == OptionKind::bytes || option.kind == OptionKind::flag;
        if (!(value >= option.minimum && value <= option.maximum) ||
            (isWhole && value != std::floor(value))) {
            reader.fail(name, "is out of its range");
        }
        if (std::find(kOwn.begin(), kOwn.end(), option.name) == kOwn.end()) {
            option.set(options, value);
        }
    }
    options.lighting = readLighting(reader);
    return options;
}

}  // namespace fluxwalk::solve
