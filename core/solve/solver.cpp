#include "core/solve/solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/solve/coarsen.h"
#include "core/solve/first_guess.h"
#include "core/solve/probes.h"
#include "core/solve/refine.h"
#include "core/solve/row_scaling.h"
#include "core/solve/run.h"

namespace fluxwalk::solve {

namespace {

using Clock = std::chrono::steady_clock;

/// Each level tightens the threshold by this factor.
constexpr double kTighten = 4.0;
/// Points at which the error is estimated.
constexpr std::size_t kProbeCount = 128;
/// Measured on the Cornell box: the true error of gathered values is 1.5 to 2 times their change from one
/// level to the next.
constexpr double kErrorOfChange = 2.0;
constexpr std::size_t kAuditRays = 8192;
constexpr std::size_t kFinalAuditRays = 262144;
constexpr int kSweepsPerLevel = 4;
constexpr int kFinalSweeps = 100;
constexpr double kFinalResidual = 1e-6;

/// Memory held before a solve differs a little from run to run; its budget shall not.
constexpr std::uint64_t kBaseStep = 16 << 20;
/// A memory limit below this many times the memory held at first asks for the size of the display first.
constexpr std::uint64_t kTightLimit = 8;

std::uint64_t roundUp(std::uint64_t bytes) {
    return (bytes + kBaseStep - 1) / kBaseStep * kBaseStep;
}

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Whether sweeps over the same links end in the same light.
bool sweepsAlike(const Options& a, const Options& b) {
    return a.pullRule == b.pullRule && a.rowScaling == b.rowScaling && a.lighting == b.lighting;
}

void checkSize(const Problem& problem) {
    const std::size_t patches = problem.hierarchy.patches().size();
    if (!problem.takesClusterLinks() && patches > kMaxPairedPatches) {
        throw base::UsageError("the scene has " + std::to_string(patches) +
                               " patches that light reaches; without cluster links all pairs of them are "
                               "linked, and at most " +
                               std::to_string(kMaxPairedPatches) + " are taken");
    }
}

}  // namespace

struct Solver::State {
    State(std::shared_ptr<const scene::Scene> scene, const Options& options, unsigned threads)
        : problem(std::move(scene), options, threads),
          display(problem),
          probes(drawProbes(problem, kProbeCount, options.seed)),
          base(roundUp(base::residentMemory())),
          machineLimit(base + base::availableMemory() / 4 * 3),
          builtNodes(problem.hierarchy.nodeCount()),
          publisher(problem, display) {}

    // What the present options allow.
    Budget budget() const {
        const Options& o = problem.options;
        return {o.linkLimit, memoryLimit(), footprint()};
    }
    std::uint64_t memoryLimit() const {
        return problem.options.memoryLimit > 0 ? problem.options.memoryLimit : machineLimit;
    }
    Footprint footprint() const {
        return {base + problem.known.bytes(), builtNodes, display.bytes(), display.shownNodes()};
    }
    std::uint64_t bytes() const {
        return footprint().bytes(problem.hierarchy.nodeCount(), problem.linkCount());
    }

    Problem problem;
    DisplayUpdate display;
    std::vector<Probe> probes;
    std::uint64_t base;          ///< bytes held once all this is made
    std::uint64_t machineLimit;  ///< bytes, where the options name no limit
    std::size_t builtNodes;
    LoopState loop;
    /// Of the last sweeps to the end, as long as what they left stands.
    std::optional<Options> convergedWith;
    Publisher publisher;
};

Solver::Solver(std::shared_ptr<const scene::Scene> scene, const Options& options, unsigned threads) {
    const Clock::time_point start = Clock::now();
    state_ = std::make_unique<State>(std::move(scene), options, threads);
    checkSize(state_->problem);
    state_->problem.statistics.times.build = secondsSince(start);
}

Solver::~Solver() = default;

void Solver::setOptions(const Options& options) {
    LoopState& loop = state_->loop;
    Problem& problem = state_->problem;
    if (loop.isStarted) {
        loop.asked =
            mergeAsked(loop.asked, compareOptions(problem.options, options, problem.statistics.history));
    }
    problem.options = options;
    loop.hasChanged = true;
}
const Options& Solver::options() const {
    return state_->problem.options;
}
const Statistics& Solver::statistics() const {
    return state_->problem.statistics;
}
const Problem& Solver::problem() const {
    return state_->problem;
}
base::NamedArrays Solver::checkpoint() const {
    return saveState(state_->problem, state_->loop);
}
void Solver::restore(const base::NamedArrays& arrays, const std::string& file) {
    restoreState(state_->problem, state_->loop, arrays, file);
    const bool isUnmeasured = state_->problem.statistics.history.empty() && state_->loop.gathered.empty();
    if (!isUnmeasured && state_->loop.gathered.size() != state_->probes.size()) {
        throw base::FileError(file, "", "was measured at other points");
    }
}
std::uint64_t Solver::countBytes() const {
    return state_->bytes();
}
std::shared_ptr<const Snapshot> Solver::show(const Detail& detail) {
    return state_->publisher.make(detail, true);
}
scene::LitMeshes Solver::litMeshes() const {
    return state_->display.refresh();
}

// Error of what is asked for, as a part of the mean irradiance: displayed values against gathered ones, and
// gathered ones against those of the level before.
double Solver::estimateError() {
    State& state = *state_;
    const StageTimer timer(state.problem.statistics.times.audit);
    std::vector<Rgb> now = gatherProbes(state.problem, state.probes);
    const bool isFirst = state.loop.gathered.empty();
    const double gatherError = isFirst ? 1.0 : kErrorOfChange * relativeRmsOffLamps(state.loop.gathered, now);
    state.loop.gathered = std::move(now);
    if (state.problem.options.errorOf == ErrorOf::gathered) {
        return gatherError;
    }
    const double displayError =
        relativeRmsOffLamps(state.display.valuesAt(state.probes), state.loop.gathered);
    return std::sqrt(gatherError * gatherError + displayError * displayError);
}

// The first guess, and what can be known of the memory it takes.
void Solver::start() {
    State& state = *state_;
    Problem& problem = state.problem;
    state.loop.isStarted = true;
    problem.links.index(problem.hierarchy.nodeCount());
    problem.hierarchy.relight(problem.options.lighting, problem.executor);
    state.loop.ambient = estimateAmbient(problem);
    seedRadiosity(problem, state.loop.ambient);
    problem.statistics.meanIrradiance = state.loop.ambient;
    problem.statistics.threshold = firstThreshold(problem.options.oracle, state.loop.ambient) * kTighten;
    if (state.memoryLimit() < kTightLimit * state.base) {
        state.budget().require(state.builtNodes, 1);
        state.display.refresh();
    }
}

// The next threshold: tighter, or what new options ask for, or, where a limit or a stop left links that it
// asks to refine, the same again.
void Solver::tighten() {
    State& state = *state_;
    Problem& problem = state.problem;
    Statistics& statistics = problem.statistics;
    problem.rowScale.clear();
    state.loop.stage = Stage::refine;
    const Asked asked = std::exchange(state.loop.asked, {});
    const bool isOver = !state.budget().holds(problem.hierarchy.nodeCount(), problem.linkCount());
    const bool hasLinks = !problem.links.links.empty();
    state.loop.isCoarsening = hasLinks && (asksForCoarser(problem) || isOver || asked.turn >= Turn::coarser);
    if (state.loop.isCoarsening) {
        const double first = firstThreshold(problem.options.oracle, state.loop.ambient);
        statistics.threshold =
            asked.turn == Turn::anew
                ? std::max(first, problem.options.threshold)
                : std::max({statistics.threshold, asked.threshold, problem.options.threshold});
        dropLinks(problem);
        if (asked.turn == Turn::anew || isOver) {
            problem.known.clear();
        }
        if (isOver || hasTooSmallElements(problem)) {
            pruneElements(problem);
        }
    } else if (statistics.largestError <= statistics.threshold && asked.turn != Turn::finer) {
        statistics.threshold = std::max(statistics.threshold / kTighten, problem.options.threshold);
    }
}

// Turns the lights; sweeps then follow. Thresholds keep their meaning beside the light there is.
void Solver::relight() {
    State& state = *state_;
    Problem& problem = state.problem;
    Statistics& statistics = problem.statistics;
    if (state.loop.ambient <= 0.0) {
        // All was dark: nothing is refined yet.
        start();
        return;
    }
    if (!problem.pending.empty()) {
        // What was restored in the midst of refinement stands as it is.
        refineLinks(problem, statistics.threshold, state.budget(), [] { return true; });
    }
    const double before = estimateAmbient(problem);
    problem.hierarchy.relight(problem.options.lighting, problem.executor);
    if (const double now = estimateAmbient(problem); now > 0.0) {
        // While all is dark, the last light stays the measure.
        const double ratio = now / (before > 0.0 ? before : state.loop.ambient);
        statistics.threshold = std::max(statistics.threshold * ratio, problem.options.threshold);
        state.loop.ambient *= ratio;
    } else {
        // Sweeps would take what is left down by a constant factor each, and never to an end.
        darken(problem);
    }
    problem.rowScale.clear();
    statistics.estimatedError = -1.0;
    state.loop.stage = Stage::follow;
    state.loop.sweeps = 0;
}

// The next level refines what the new light asks for to the threshold there is, and is compared with this
// one.
void Solver::finishFollowing() {
    State& state = *state_;
    const StageTimer timer(state.problem.statistics.times.audit);
    state.loop.gathered = gatherProbes(state.problem, state.probes);
    state.loop.stage = Stage::refine;
    state.loop.isCoarsening = false;
}

Outcome Solver::solve(const Callbacks& callbacks) {
    State& state = *state_;
    Problem& problem = state.problem;
    Statistics& statistics = problem.statistics;
    Run run(problem, callbacks, state.loop, state.publisher);
    problem.keepsKnown = callbacks.newOptions != nullptr && problem.options.memoryLimit == 0;
    if (!state.loop.isStarted) {
        start();
    }
    const auto isStopped = [&run] { return run.isStopped(); };
    // Whether what was asked for holds already: then only the display changes.
    const auto isReached = [&] {
        return problem.options.threshold > 0.0 ? statistics.largestError <= problem.options.threshold
                                               : statistics.estimatedError <= problem.options.error;
    };
    // Nothing left to split: the smallest elements bound the error.
    const auto isExhausted = [&] {
        return !state.loop.hasChanged && statistics.history.size() > 3 && problem.options.threshold <= 0.0 &&
               statistics.threshold < 1e-9 * state.loop.ambient;
    };
    const auto isSettled = [&] {
        return state.loop.asked.turn == Turn::none && !asksForCoarser(problem) &&
               (isReached() || isExhausted());
    };
    if (run.wantsRelight() && state.loop.ambient <= 0.0) {
        relight();
    }
    const bool isEmpty = problem.hierarchy.patches().empty() || state.loop.ambient <= 0.0;
    Limit limit = Limit::none;
    const bool isBetweenLevels = state.loop.stage == Stage::tighten && !run.wantsRelight();
    const bool isAtRest = isBetweenLevels && !statistics.history.empty() && isSettled();
    bool isDone = isEmpty || isAtRest;
    const std::optional<Options> converged = std::exchange(state.convergedWith, std::nullopt);
    if (isAtRest && converged && sweepsAlike(*converged, problem.options)) {
        // Even the last sweeps have been made. Showing that takes a while: more may be asked for meanwhile.
        run.publish(true);
        isDone = isSettled() && !run.wantsRelight();
        if (isDone && sweepsAlike(*converged, problem.options)) {
            state.convergedWith = problem.options;
            return run.outcome(limit);
        }
        run.takeTurn();
    }
    while (!isDone) {
        if (run.wantsRelight()) {
            relight();
        }
        if (state.loop.stage == Stage::follow) {
            run.report("relighting");
            run.hurry();
            run.sweep(kFinalSweeps, kFinalResidual);
            if (run.wantsRelight()) {
                continue;
            }
            run.hurry();
            run.publish(false);
            finishFollowing();
            if (run.isCut()) {
                break;
            }
        }
        if (state.loop.stage == Stage::tighten) {
            tighten();
        }
        if (state.loop.stage == Stage::refine) {
            run.report("refining");
            const Refined refined = refineLinks(
                problem, statistics.threshold, state.budget(), isStopped,
                [&run](std::span<const Decision> underway) { return run.isCalledAway(underway); });
            if (state.loop.isCoarsening) {
                pruneElements(problem);
            }
            state.loop.hasChanged = refined.hasChanged;
            limit = refined.limit;
            if (statistics.history.empty()) {
                run.makeDue();
            }
            state.loop.stage = Stage::sweep;
            state.loop.sweeps = 0;
        }
        if (run.wantsRelight() && !run.isCut()) {
            continue;
        }
        run.sweep(kSweepsPerLevel, 0.05 * problem.options.error);
        if (run.wantsRelight() && !run.isCut()) {
            continue;
        }
        state.loop.stage = Stage::tighten;
        run.audit(kAuditRays);
        statistics.estimatedError = estimateError();
        statistics.history.push_back({run.seconds(), statistics.threshold, statistics.residual,
                                      statistics.estimatedError, statistics.counters.links});
        statistics.counters.bytesCounted = state.bytes();
        const bool isTurned = run.takeTurn();
        if (!run.isCut() && !isTurned) {
            run.finishLevel();
        }
        run.publish(false);
        run.isStopped();
        const bool isAsked = run.wantsRelight() || state.loop.asked.turn != Turn::none;
        isDone = run.isCut() || (!isAsked && (limit != Limit::none || isSettled()));
    }
    problem.rowScale = problem.options.rowScaling ? computeRowScaling(problem) : std::vector<float>{};
    run.report("converging");
    run.beginLastSweeps();
    run.sweep(kFinalSweeps, kFinalResidual);
    if (!run.isCut()) {
        state.convergedWith = problem.options;
    }
    run.audit(kFinalAuditRays);
    run.publish(true);
    statistics.times.total = run.seconds();
    return run.outcome(limit);
}

}  // namespace fluxwalk::solve
