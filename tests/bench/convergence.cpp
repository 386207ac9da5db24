#include "tests/bench/convergence.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

namespace fluxwalk::bench {

namespace {

using Clock = std::chrono::steady_clock;

/// Wall time that can be stopped while the bench itself works.
class Stopwatch {
  public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_ - paused_).count(); }
    void exclude(const std::function<void()>& work) {
        const Clock::time_point begin = Clock::now();
        work();
        paused_ += Clock::now() - begin;
    }

  private:
    Clock::time_point start_ = Clock::now();
    Clock::duration paused_{};
};

TrueErrors readErrors(const Setting& setting, const solve::Solver& solver) {
    const SensorErrors sensors(solver.problem(), *setting.reference);
    return {sensors.ofLeaves(solver.problem()),
            sensors.ofMeshes(solver.litMeshes(), solver.problem().executor), sensors.ofGathered(solver)};
}

}  // namespace

FirstSnapshot measureFirstSnapshot(const Setting& setting) {
    FirstSnapshot result;
    result.seconds = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < setting.repeats; ++i) {
        std::shared_ptr<const solve::Snapshot> first;
        const Stopwatch watch;
        solve::Solver solver(setting.scene, {}, setting.threads);
        solve::Callbacks callbacks;
        callbacks.publish = [&](std::shared_ptr<const solve::Snapshot> snapshot) {
            if (!first) {
                result.seconds = std::min(result.seconds, watch.seconds());
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
            const double seconds = watch.seconds();
            if (i > 0) {
                levels[count].seconds = std::min(levels[count].seconds, seconds);
                isDone = ++count == levels.size();
                return;
            }
            watch.exclude([&] {
                levels.push_back({seconds, solver.statistics(), readErrors(setting, solver)});
            });
            isDone = levels.back().errors.of(what) <= error || seconds > setting.secondsLimit;
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

ClosedLoop measureClosedLoop(const Setting& setting, solve::ErrorOf what, double error) {
    ClosedLoop result{what, error, std::numeric_limits<double>::infinity(), false, {}, {}};
    solve::Options options;
    options.error = error;
    options.errorOf = what;
    options.timeLimit = setting.secondsLimit;
    for (unsigned i = 0; i < setting.repeats; ++i) {
        const Stopwatch watch;
        solve::Solver solver(setting.scene, options, setting.threads);
        const solve::Outcome outcome = solver.solve({});
        const double seconds = watch.seconds();
        if (seconds < result.seconds) {
            result.seconds = seconds;
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
