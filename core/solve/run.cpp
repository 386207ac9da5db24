#include "core/solve/run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/solve/audit.h"
#include "core/solve/coarsen.h"
#include "core/solve/first_guess.h"
#include "core/solve/preview.h"
#include "core/solve/sweep.h"

namespace fluxwalk::solve {

namespace {

/// Even a stopped solve sweeps this often over its last links, so that what it keeps is lit.
constexpr int kSweepsAfterStop = 2;
constexpr double kPublishInterval = 0.1;  ///< seconds
/// Of the time, snapshots take no more than about one part in this many.
constexpr double kPublishShare = 8.0;
/// The first level's picture waits for its third sweep or so: a millisecond more, and interreflection is
/// there.
constexpr double kFirstResidual = 0.04;
/// What new options do is shown after so many seconds, as far as it has come by then.
constexpr double kFirstEffect = 0.05;
/// Of pictures from the midst of a refinement.
constexpr int kPreviewSweeps = 2;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::chrono::steady_clock::duration toDuration(double seconds) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(seconds));
}

}  // namespace

Run::Run(Problem& problem, const Callbacks& callbacks, LoopState& loop, Publisher& publisher)
    : problem_(problem),
      callbacks_(callbacks),
      loop_(loop),
      publisher_(publisher),
      before_(problem.statistics.times.total),
      due_(publisher.count() > 0 ? start_ + toDuration(kFirstEffect) : start_) {}

void Run::takeNewOptions() {
    const auto changed = callbacks_.newOptions ? callbacks_.newOptions() : std::nullopt;
    if (!changed) {
        return;
    }
    const Options built = problem_.options;
    due_ = std::min(due_, Clock::now() + toDuration(kFirstEffect));
    isHurried_ = isHurried_ || built.displayAngle != changed->displayAngle;
    loop_.hasChanged = true;
    loop_.asked = mergeAsked(loop_.asked, compareOptions(built, *changed, problem_.statistics.history));
    problem_.options = *changed;
    problem_.options.seed = built.seed;
    problem_.options.clusters = built.clusters;
    problem_.options.clusterModel = built.clusterModel;
    problem_.options.rays = built.rays;
    problem_.options.visibilityRays = built.visibilityRays;
    if (problem_.hierarchy.patches().size() > kMaxPairedPatches) {
        problem_.options.clusterLinks = ClusterLinks::on;
    }
    isTurned_ = isTurned_ || asksForCoarser(problem_) || loop_.asked.turn >= Turn::coarser;
}

void Run::tell(Moment moment) {
    if (callbacks_.resumable && isResumable_) {
        problem_.statistics.times.total = seconds();
        callbacks_.resumable(moment);
    }
}

bool Run::isStopped() {
    if (isResumable_) {
        takeNewOptions();
    }
    if (!isCut()) {
        wasStopped_ = callbacks_.shouldStop && callbacks_.shouldStop();
        const double limit = problem_.options.timeLimit;
        isOutOfTime_ = limit > 0.0 && seconds() - loop_.secondsBefore > limit;
        tell(isCut() ? Moment::stop : Moment::wave);
    }
    return isCut() || isTurned_ || wantsRelight();
}

bool Run::wantsRelight() const {
    return !(problem_.options.lighting == problem_.hierarchy.lighting());
}

bool Run::takeTurn() {
    return std::exchange(isTurned_, false);
}

void Run::sweep(int most, double residual) {
    Sweeper sweeper(problem_);
    Statistics& statistics = problem_.statistics;
    while (loop_.sweeps < most) {
        statistics.residual = sweeper.sweep();
        statistics.meanIrradiance = meanIrradiance(problem_.hierarchy);
        ++loop_.sweeps;
        if (statistics.residual <= residual) {
            loop_.sweeps = most;
        }
        settle();
        if (loop_.sweeps >= kSweepsAfterStop && isStopped()) {
            break;
        }
        publish(false);
    }
}

void Run::settle() {
    if (callbacks_.settled) {
        const Clock::time_point before = Clock::now();
        callbacks_.settled();
        start_ += Clock::now() - before;
    }
}

void Run::audit(std::size_t rays) {
    const StageTimer timer(problem_.statistics.times.audit);
    problem_.statistics.audit = auditEnergy(problem_, rays);
}

bool Run::isTimeToPublish() const {
    return isHurried_ || Clock::now() >= due_;
}

void Run::publish(bool isFinished) {
    const bool isRough = problem_.statistics.history.empty() && problem_.statistics.residual > kFirstResidual;
    const bool isTooEarly = !isHurried_ && (isRough || !isTimeToPublish());
    if (!callbacks_.publish || (!isFinished && isTooEarly)) {
        return;
    }
    const Clock::time_point start = Clock::now();
    deliver(isFinished);
    rest(secondsSince(start));
}

void Run::rest(double publishTime) {
    due_ = Clock::now() + toDuration(std::max(kPublishInterval, kPublishShare * publishTime));
}

void Run::deliver(bool isFinished) {
    isHurried_ = false;
    problem_.statistics.times.total = seconds();
    while (publisher_.count() > 0 && publisher_.shownAngle() != problem_.options.displayAngle) {
        auto part = publisher_.makePart(callbacks_.detail ? callbacks_.detail() : Detail{}, kFirstEffect);
        if (part == nullptr) {
            break;
        }
        callbacks_.publish(std::move(part));
        // Another angle may have been asked for by now.
        if (isResumable_) {
            takeNewOptions();
        }
    }
    callbacks_.publish(publisher_.make(callbacks_.detail ? callbacks_.detail() : Detail{}, isFinished));
}

bool Run::isCalledAway(std::span<const Decision> underway) {
    if (isResumable_) {
        takeNewOptions();
    }
    if (isTurned_ || wantsRelight()) {
        return true;
    }
    // Limits of memory count what refining takes, and not a second set of links.
    if (!callbacks_.publish || problem_.options.memoryLimit > 0 || !isTimeToPublish()) {
        return false;
    }
    // Until there has been a whole picture, a guess stands for what has no links yet.
    const bool isWhole = canPreview(problem_, underway);
    const bool isFirst = publisher_.count() == 0;
    if (isWhole || (problem_.statistics.history.empty() && loop_.ambient > 0.0)) {
        const Clock::time_point start = Clock::now();
        preview(problem_, underway, {kPreviewSweeps, kFirstResidual, isWhole ? 0.0 : loop_.ambient}, [this] {
            settle();
            deliver(false);
        });
        // The first one makes all meshes, which takes much longer than their light.
        rest(isFirst ? 0.0 : secondsSince(start));
    }
    return false;
}

void Run::report(const char* stage) {
    if (!callbacks_.progress) {
        return;
    }
    // Errors fall by about a constant factor a level: progress is the part of the levels that are done.
    const double error = problem_.statistics.estimatedError;
    const double wanted = std::max(1e-6, problem_.options.error);
    const double share = error > 0.0 ? std::log(1.0 / error) / std::log(1.0 / std::min(0.5, wanted)) : 0.0;
    callbacks_.progress(std::clamp(share, 0.0, 1.0), stage);
}

void Run::finishLevel() {
    tell(Moment::level);
}

void Run::beginLastSweeps() {
    isResumable_ = false;
    loop_.sweeps = 0;
}

double Run::seconds() const {
    return before_ + secondsSince(start_);
}

Outcome Run::outcome(Limit limit) const {
    return wasStopped_              ? Outcome::stopped
           : isOutOfTime_           ? Outcome::reachedTimeLimit
           : limit == Limit::links  ? Outcome::reachedLinkLimit
           : limit == Limit::memory ? Outcome::reachedMemoryLimit
                                    : Outcome::reachedError;
}

}  // namespace fluxwalk::solve
