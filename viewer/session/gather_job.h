#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "core/image/display_gather.h"
#include "core/solve/solver.h"

/// The display's light, gathered while the solver rests.
namespace fluxwalk::session {

struct GatherProgress {
    std::size_t leaves = 0;       ///< in all
    std::size_t done = 0;         ///< leaves that have their light
    std::size_t seenPending = 0;  ///< of those that are seen, how many have not
};

/// What came of a moment's work.
struct GatherStep {
    /// The solution with the light that is gathered; the one before where there is no newer.
    std::shared_ptr<const solve::Snapshot> snapshot;
    GatherProgress progress;
    bool isFinished = true;  ///< nothing is left, and all of it was shown
};

/// Owned by the session's thread. Light that was gathered stays as long as the solution does, even where that
/// was asked to go on and found nothing to do.
class GatherJob {
  public:
    /// Works for about a tenth of a second. `solved` is the solver's newest snapshot; what it tells of
    /// elements comes for the finer meshes too, but those with residuals or errors of links are returned as
    /// they are: they show no light.
    GatherStep step(const solve::Solver& solver, const image::Look& look,
                    std::shared_ptr<const solve::Snapshot> solved);

    /// The solution may change: to be called before the solver goes on.
    void doubt() { isDoubtful_ = true; }
    /// The solver goes.
    void forget() {
        gather_.reset();
        shown_.reset();
    }

  private:
    using Clock = image::DisplayGather::Clock;

    std::shared_ptr<const solve::Snapshot> show(const solve::Solver& solver, const solve::Snapshot& solved);

    std::unique_ptr<image::DisplayGather> gather_;
    std::uint64_t digest_ = 0;  ///< of the solution that it gathers from
    bool isDoubtful_ = true;
    std::shared_ptr<const solve::Snapshot> shown_;
    std::shared_ptr<const solve::Snapshot> shownOf_;  ///< what it was made of
    std::size_t shownDone_ = 0;
    bool wasSeenPending_ = true;
    Clock::time_point due_{};  ///< of the next snapshot
};

}  // namespace fluxwalk::session
