#include "tests/bench/convergence.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

namespace fluxwalk::bench {

namespace {

using Clock = std::chrono::steady_clock;

/// Time that can be stopped while the bench itself works.
class Stopwatch {
  public:
    Duration read() const {
        return {std::chrono::duration<double>(Clock::now() - start_).count(),
                static_cast<double>(std::clock() - cpuStart_) / CLOCKS_PER_SEC};
    }
    void exclude(const std::function<void()>& work) {
        const Clock::time_point begin = Clock::now();
        const std::clock_t cpuBegin = std::clock();
        work();
        start_ += Clock::now() - begin;
        cpuStart_ += std::clock() - cpuBegin;
    }

  private:
    Clock::time_point start_ = Clock::now();
    std::clock_t cpuStart_ = std::clock();
};

void keepFaster(Duration& best, const Duration& other) {
    if (other.seconds < best.seconds) {
        best = other;
    }
}

TrueErrors readErrors(const Setting& setting, const solve::Solver& solver) {
    const SensorErrors sensors(solver.problem(), *setting.reference);
    return {sensors.ofLeaves(solver.problem()),
            sensors.ofMeshes(solver.litMeshes(), solver.problem().executor), sensors.ofGathered(solver)};
}

}  // namespace

FirstSnapshot measureFirstSnapshot(const Setting& setting) {
    FirstSnapshot result;
    for (unsigned i = 0; i < setting.repeats; ++i) {
        std::shared_ptr<const solve::Snapshot> first;
        const Stopwatch watch;
        solve::Solver solver(setting.scene, {}, setting.threads);
        solve::Callbacks callbacks;
        callbacks.publish = [&](std::shared_ptr<const solve::Snapshot> snapshot) {
            if (!first) {
                keepFaster(result.duration, watch.read());
                first = std::move(snapshot);
            }
        };
        callbacks.shouldStop = [&] { return first != nullptr; };
        solver.solve(callbacks);
        if (i == 0) {
            const SensorErrors sensors(solver.problem(), *setting.reference);
            result.error = sensors.ofMeshes(first->meshes, solver.problem().executor).rms;
            result.links = first->statistics.counters.links;
            result.leaves = first->statistics.counters.leaves;
        }
    }
    return result;
}

std::vector<Level> measureLevels(const Setting& setting, solve::ErrorOf what, double error) {
    std::vector<Level> levels;
    for (unsigned i = 0; i < setting.repeats; ++i) {
        std::size_t count = 0;
        bool isDone = false;
        std::uint64_t sweeps = 0;
        solve::Options options;
        options.error = error;
        options.errorOf = what;
        options.clusterLinks = setting.clusterLinks;
        // Any threshold of the user's keeps the loop from stopping by its own estimate.
        options.threshold = std::numeric_limits<double>::min();
        Stopwatch watch;
        solve::Solver solver(setting.scene, options, setting.threads);
        solve::Callbacks callbacks;
        callbacks.shouldStop = [&] { return isDone; };
        callbacks.progress = [&](double, const char*) {
            if (isDone || solver.statistics().counters.sweeps == sweeps) {
                return;
            }
            sweeps = solver.statistics().counters.sweeps;
            const Duration duration = watch.read();
            if (i > 0) {
                keepFaster(levels[count].duration, duration);
                isDone = ++count == levels.size();
                return;
            }
            watch.exclude([&] {
                levels.push_back({duration, solver.statistics(), readErrors(setting, solver)});
            });
            isDone = levels.back().errors.of(what) <= error || duration.seconds > setting.secondsLimit;
        };
        solver.solve(callbacks);
    }
    return levels;
}

const Level* firstBelow(std::span<const Level> levels, solve::ErrorOf what, double error) {
    const auto found = std::find_if(levels.begin(), levels.end(),
                                    [&](const Level& level) { return level.errors.of(what) <= error; });
    return found == levels.end() ? nullptr : &*found;
}

std::optional<double> interpolateSeconds(std::span<const Level> levels, solve::ErrorOf what, double error) {
    const Level* below = firstBelow(levels, what, error);
    if (below == nullptr || below == levels.data()) {
        return std::nullopt;
    }
    const Level& above = *(below - 1);
    const double from = above.errors.of(what);
    const double to = std::max(below->errors.of(what), 1e-3 * error);
    const double part = std::log(from / error) / std::log(from / to);
    return above.duration.seconds * std::pow(below->duration.seconds / above.duration.seconds, part);
}

ClosedLoop measureClosedLoop(const Setting& setting, solve::ErrorOf what, double error) {
    ClosedLoop result{what, error, {}, false, {}, {}};
    solve::Options options;
    options.error = error;
    options.errorOf = what;
    options.clusterLinks = setting.clusterLinks;
    options.timeLimit = setting.secondsLimit;
    for (unsigned i = 0; i < setting.repeats; ++i) {
        const Stopwatch watch;
        solve::Solver solver(setting.scene, options, setting.threads);
        const solve::Outcome outcome = solver.solve({});
        const Duration duration = watch.read();
        if (duration.seconds < result.duration.seconds) {
            result.duration = duration;
            result.statistics = solver.statistics();
            result.isReached = outcome == solve::Outcome::reachedError;
        }
        if (i + 1 == setting.repeats) {
            result.errors = readErrors(setting, solver);
        }
    }
    return result;
}

}  // namespace fluxwalk::bench
