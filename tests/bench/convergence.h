#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/sensor_errors.h"

/// Time to error, two ways: the levels of one refining run, with the true error after each; and the closed
/// loop, which has to find out by itself when to stop.
namespace fluxwalk::bench {

/// What every run is made with. Seconds count from a loaded scene: rays, hierarchy and probes are built
/// within.
struct Setting {
    std::shared_ptr<const scene::Scene> scene;
    const std::vector<ReferencePoint>* reference = nullptr;
    unsigned threads = 0;
    unsigned repeats = 3;      ///< the fastest counts: other work on the machine only adds
    double secondsLimit = 20;  ///< of one run
    solve::ClusterLinks clusterLinks = solve::ClusterLinks::automatic;
};

/// The solution in all three readings.
struct TrueErrors {
    ErrorFigures leaves;
    ErrorFigures displayed;
    ErrorFigures gathered;

    double of(solve::ErrorOf what) const {
        return what == solve::ErrorOf::displayed ? displayed.rms : gathered.rms;
    }
};

struct Duration {
    double seconds = std::numeric_limits<double>::infinity();
    double cpuSeconds = 0.0;  ///< of all threads, in the same run: hardly depends on other work
};

struct FirstSnapshot {
    Duration duration;
    double error = 0.0;  ///< p of its meshes
    std::uint64_t links = 0;
    std::uint64_t leaves = 0;
};
FirstSnapshot measureFirstSnapshot(const Setting& setting);

struct Level {
    Duration duration;  ///< from the start; evaluation of the true error left out
    solve::Statistics statistics;
    TrueErrors errors;
};
/// Refines until the true error of `what` is below `error`, or the time is over.
std::vector<Level> measureLevels(const Setting& setting, solve::ErrorOf what, double error);

/// The first level whose error is at most `error`; nullptr where none is.
const Level* firstBelow(std::span<const Level> levels, solve::ErrorOf what, double error);

/// Seconds at which the error passes `error` on a straight line between levels in logarithms: moves less by
/// chance than the first level below. Nothing where no level is below, or already the first.
std::optional<double> interpolateSeconds(std::span<const Level> levels, solve::ErrorOf what, double error);

struct ClosedLoop {
    solve::ErrorOf what{};
    double requested = 0.0;
    Duration duration;
    bool isReached = false;  ///< false: out of time
    solve::Statistics statistics;
    TrueErrors errors;
};
ClosedLoop measureClosedLoop(const Setting& setting, solve::ErrorOf what, double error);

}  // namespace fluxwalk::bench
