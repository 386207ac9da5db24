#include "core/solve/solver.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/solve/audit.h"
#include "core/solve/checkpoint.h"
#include "core/solve/display_update.h"
#include "core/solve/probes.h"
#include "core/solve/refine.h"
#include "core/solve/row_scaling.h"
#include "core/solve/state.h"
#include "core/solve/sweep.h"

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
/// Even a stopped solve sweeps this often over its last links, so that what it keeps is lit.
constexpr int kSweepsAfterStop = 2;
constexpr double kFinalResidual = 1e-6;
constexpr double kPublishInterval = 0.1;  ///< seconds
/// Of the time, snapshots take no more than about one part in this many.
constexpr double kPublishShare = 8.0;
/// The first picture waits for its third sweep or so: a millisecond more, and interreflection is there.
constexpr double kFirstResidual = 0.04;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// What the whole scene would get if its light were mixed well and half of it lost: the first guess for what
// is not lit yet, so that the oracle sees interreflection before the first sweep. Also the unit of the first
// threshold.
double estimateAmbient(const Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    double flux = 0.0;
    double reflected = 0.0;
    for (const NodeId id : h.patches()) {
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        flux += area * static_cast<double>(base::channelMean(h.light(id).emission));
        reflected += area * static_cast<double>(base::channelMean(h.light(id).reflectance));
    }
    for (const NodeId id : h.sources()) {
        const bool isPointLike =
            h.kind(id) == hierarchy::NodeKind::light &&
            problem.scene->lights[h.lightIndex(id)].kind != scene::LightKind::directional;
        const double measure = isPointLike ? 4.0 * base::kPi : 0.1 * h.totalArea();
        flux += measure * static_cast<double>(base::channelMean(h.light(id).radiosity));
    }
    const double area = h.totalArea();
    return area > reflected ? 0.5 * flux / (area - reflected) : 0.0;
}

void seedRadiosity(Problem& problem, float ambient) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    for (const NodeId id : h.patches()) {
        hierarchy::Light& light = h.light(id);
        light.irradiance = Rgb(ambient);
        light.radiosity = light.emission + light.reflectance * ambient;
        light.residual = 0.5f * base::channelMean(light.reflectance) * ambient;
    }
    h.pullClusters();
}

double meanIrradiance(const hierarchy::Hierarchy& h) {
    double sum = 0.0;
    for (const NodeId id : h.patches()) {
        sum += static_cast<double>(h.shape(id).exposedArea() * base::channelMean(h.light(id).irradiance));
    }
    return h.totalArea() > 0.0 ? sum / h.totalArea() : 0.0;
}

/// Without cluster links all pairs of patches would be linked: beyond this many they would fill the memory.
constexpr std::size_t kMaxPairedPatches = 8000;

void checkSize(const Problem& problem) {
    const std::size_t patches = problem.hierarchy.patches().size();
    if (!problem.takesClusterLinks() && patches > kMaxPairedPatches) {
        throw base::UsageError("the scene has " + std::to_string(patches) +
                               " patches that light reaches; without cluster links all pairs of them are "
                               "linked, and at most " +
                               std::to_string(kMaxPairedPatches) + " are taken");
    }
}

double firstThreshold(OracleKind oracle, double ambient) {
    return ambient * (oracle == OracleKind::bf ? 0.3 : 1e-3);
}

}  // namespace

struct Solver::State {
    State(std::shared_ptr<const scene::Scene> scene, const Options& options, unsigned threads)
        : problem(std::move(scene), options, threads),
          display(problem),
          probes(drawProbes(problem, kProbeCount, options.seed)) {}

    Problem problem;
    DisplayUpdate display;
    std::vector<Probe> probes;
    LoopState loop;
    std::uint64_t sequence = 0;
};

namespace {

/// One call of Solver::solve.
class Run {
  public:
    Run(Problem& problem, DisplayUpdate& display, const Callbacks& callbacks, LoopState& loop,
        std::uint64_t& sequence)
        : problem_(problem),
          display_(display),
          callbacks_(callbacks),
          loop_(loop),
          sequence_(sequence),
          before_(problem.statistics.times.total) {}

    bool isStopped() {
        if (callbacks_.newOptions) {
            if (const auto changed = callbacks_.newOptions()) {
                const Options built = problem_.options;
                loop_.hasChanged = true;
                problem_.options = *changed;
                problem_.options.seed = built.seed;
                problem_.options.clusters = built.clusters;
                problem_.options.rays = built.rays;
                if (problem_.hierarchy.patches().size() > kMaxPairedPatches) {
                    problem_.options.clusterLinks = ClusterLinks::on;
                }
            }
        }
        wasStopped_ = wasStopped_ || (callbacks_.shouldStop && callbacks_.shouldStop());
        const double limit = problem_.options.timeLimit;
        isOutOfTime_ = isOutOfTime_ || (limit > 0.0 && seconds() - loop_.secondsBefore > limit);
        return isCut();
    }
    /// Whether a stop has been seen.
    bool isCut() const { return wasStopped_ || isOutOfTime_; }

    double seconds() const { return before_ + secondsSince(start_); }
    Outcome outcome() const {
        return wasStopped_    ? Outcome::stopped
               : isOutOfTime_ ? Outcome::reachedTimeLimit
                              : Outcome::reachedError;
    }

    void publish(bool isFinished) {
        problem_.statistics.times.total = seconds();
        const double wait = std::max(kPublishInterval, kPublishShare * publishTime_);
        const bool isTooEarly =
            sequence_ > 0 ? secondsSince(published_) < wait : problem_.statistics.residual > kFirstResidual;
        if (!callbacks_.publish || (!isFinished && isTooEarly)) {
            return;
        }
        const Clock::time_point start = Clock::now();
        auto snapshot = std::make_shared<Snapshot>();
        snapshot->sequence = ++sequence_;
        snapshot->meshes = display_.refresh();
        snapshot->statistics = problem_.statistics;
        snapshot->finished = isFinished;
        callbacks_.publish(std::move(snapshot));
        published_ = Clock::now();
        publishTime_ = secondsSince(start);
    }

    void sweep(int most, double residual) {
        Sweeper sweeper(problem_);
        Statistics& statistics = problem_.statistics;
        for (int i = 0; i < most; ++i) {
            statistics.residual = sweeper.sweep();
            statistics.meanIrradiance = meanIrradiance(problem_.hierarchy);
            if (statistics.residual <= residual || (i + 1 >= kSweepsAfterStop && isStopped())) {
                break;
            }
            publish(false);
        }
    }

    void audit(std::size_t rays) {
        const StageTimer timer(problem_.statistics.times.audit);
        problem_.statistics.audit = auditEnergy(problem_, rays);
    }

    void report(const char* stage) {
        if (!callbacks_.progress) {
            return;
        }
        // Errors fall by about a constant factor a level: progress is the part of the levels that are done.
        const double error = problem_.statistics.estimatedError;
        const double wanted = std::max(1e-6, problem_.options.error);
        const double share =
            error > 0.0 ? std::log(1.0 / error) / std::log(1.0 / std::min(0.5, wanted)) : 0.0;
        callbacks_.progress(std::clamp(share, 0.0, 1.0), stage);
    }

  private:
    Problem& problem_;
    DisplayUpdate& display_;
    const Callbacks& callbacks_;
    LoopState& loop_;
    std::uint64_t& sequence_;
    double before_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point published_{};
    double publishTime_ = 0.0;  ///< seconds that the last snapshot took
    bool wasStopped_ = false;
    bool isOutOfTime_ = false;
};

}  // namespace

Solver::Solver(std::shared_ptr<const scene::Scene> scene, const Options& options, unsigned threads) {
    const Clock::time_point start = Clock::now();
    state_ = std::make_unique<State>(std::move(scene), options, threads);
    checkSize(state_->problem);
    state_->problem.statistics.times.build = secondsSince(start);
}

Solver::~Solver() = default;

void Solver::setOptions(const Options& options) {
    state_->problem.options = options;
    state_->loop.hasChanged = true;
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
    if (state_->loop.gathered.size() != state_->probes.size()) {
        throw base::FileError(file, "", "was measured at other points");
    }
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
    const double gatherError = isFirst ? 1.0 : kErrorOfChange * relativeRms(state.loop.gathered, now);
    state.loop.gathered = std::move(now);
    if (state.problem.options.errorOf == ErrorOf::gathered) {
        return gatherError;
    }
    const double displayError = relativeRms(state.display.valuesAt(state.probes), state.loop.gathered);
    return std::sqrt(gatherError * gatherError + displayError * displayError);
}

Outcome Solver::solve(const Callbacks& callbacks) {
    State& state = *state_;
    Problem& problem = state.problem;
    Statistics& statistics = problem.statistics;
    Run run(problem, state.display, callbacks, state.loop, state.sequence);
    if (!state.loop.isStarted) {
        state.loop.isStarted = true;
        state.loop.ambient = estimateAmbient(problem);
        seedRadiosity(problem, static_cast<float>(state.loop.ambient));
        statistics.meanIrradiance = state.loop.ambient;
        statistics.threshold = firstThreshold(problem.options.oracle, state.loop.ambient) * kTighten;
    }
    const auto isStopped = [&run] { return run.isStopped(); };
    // Whether what was asked for holds already: then only the display changes.
    const auto isReached = [&] {
        return problem.options.threshold > 0.0 ? statistics.threshold <= problem.options.threshold
                                               : statistics.estimatedError <= problem.options.error;
    };
    // Nothing left to split: the smallest elements bound the error.
    const auto isExhausted = [&] {
        return !state.loop.hasChanged && statistics.history.size() > 3 && problem.options.threshold <= 0.0 &&
               statistics.threshold < 1e-9 * state.loop.ambient;
    };
    const bool isEmpty = problem.hierarchy.patches().empty() || state.loop.ambient <= 0.0;
    for (bool isDone = isEmpty || (!statistics.history.empty() && (isReached() || isExhausted())); !isDone;) {
        statistics.threshold = std::max(statistics.threshold / kTighten, problem.options.threshold);
        problem.rowScale.clear();
        run.report("refining");
        state.loop.hasChanged = refineLinks(problem, statistics.threshold, isStopped);
        run.sweep(kSweepsPerLevel, 0.05 * problem.options.error);
        run.audit(kAuditRays);
        statistics.estimatedError = estimateError();
        statistics.history.push_back({run.seconds(), statistics.threshold, statistics.residual,
                                      statistics.estimatedError, statistics.counters.links});
        if (callbacks.levelDone && !run.isCut()) {
            statistics.times.total = run.seconds();
            callbacks.levelDone();
        }
        run.publish(false);
        isDone = run.isStopped() || isReached() || isExhausted();
    }
    if (problem.options.rowScaling) {
        problem.rowScale = computeRowScaling(problem);
    }
    run.report("converging");
    run.sweep(kFinalSweeps, kFinalResidual);
    run.audit(kFinalAuditRays);
    run.publish(true);
    statistics.times.total = run.seconds();
    return run.outcome();
}

}  // namespace fluxwalk::solve
