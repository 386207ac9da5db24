#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/image/inspect.h"
#include "core/solve/solver.h"
#include "viewer/session/gather_job.h"
#include "viewer/session/still_job.h"

/// The solver in a thread of its own.
namespace fluxwalk::session {

/// Solves with the given options until done or stopped; called again to go on. Runs on the session's thread.
using SolveFunction = std::function<solve::Outcome(const solve::Options&, const solve::Callbacks&)>;

/// Looks at the solution; called while the solver stands still, on the session's thread. May be empty.
struct Lookers {
    std::function<std::shared_ptr<const solve::Snapshot>(const solve::Detail&)> show;
    std::function<std::optional<image::Inspection>(const rays::Ray&)> inspect;
    TakeStill takeStill;
    /// Whether the light is far enough for a still while it is still being solved.
    std::function<bool()> isFitForStill;
    /// Gathers light for the display for a moment (GatherJob::step).
    std::function<GatherStep(const image::Look&, std::shared_ptr<const solve::Snapshot>)> gather;
};

/// Where its Solver comes from, and who is told when it could go on from its state (may be empty).
struct SolverSource {
    std::function<std::unique_ptr<solve::Solver>(const solve::Options&)> make;
    std::function<void(const solve::Solver&, solve::Moment)> resumable;
};

struct Solving {
    SolveFunction solve;
    Lookers look;
};

/// Makes its Solver on the first call and keeps it for the next ones.
Solving solveWith(SolverSource source);

/// What a look along a ray met.
struct Finding {
    rays::Ray ray;
    std::optional<image::Inspection> inspection;
};

enum class Phase : std::uint8_t {
    solving,
    paused,    ///< by the user; the solution so far stands
    finished,  ///< the requested error or the time limit is reached; new options make it go on
    stopped,   ///< for good
    failed     ///< by an exception, see Status::failure
};

/// What the session is doing.
struct Status {
    Phase phase = Phase::solving;
    solve::Outcome outcome = solve::Outcome::stopped;  ///< of the last solve; valid when finished
    double progress = 0.0;                             ///< in [0, 1], towards the requested error
    std::string stage;
    bool isStepping = false;  ///< goes on to the end of a level only
    GatherProgress gathered;  ///< of the display's light; of 0 leaves while none is gathered
    std::exception_ptr failure;
};

/// Owns the solver's thread. Every member may be called from any thread and none waits for the solver, except
/// wait() and the destructor. The solver reacts at its wave boundaries.
class SolverSession {
  public:
    /// Starts at once. `wake` (may be empty) is called on the solver's thread after each new snapshot and
    /// change of phase.
    SolverSession(Solving solving, const solve::Options& options, std::function<void()> wake);
    /// Without looks.
    SolverSession(SolveFunction solve, const solve::Options& options, std::function<void()> wake)
        : SolverSession(Solving{std::move(solve), {}}, options, std::move(wake)) {}
    /// Stops and joins.
    ~SolverSession();
    SolverSession(const SolverSession&) = delete;
    SolverSession& operator=(const SolverSession&) = delete;

    /// The newest snapshot; null before the first.
    std::shared_ptr<const solve::Snapshot> latest() const;
    Status status() const;

    /// Takes effect at the next wave; makes a finished session go on. Options that are fixed when a solver is
    /// made (solve::needsNewSolver) make a new one, while the last snapshot of the old one stays.
    void setOptions(const solve::Options& options);
    solve::Options options() const;
    void setPaused(bool paused);
    /// Goes on until the end of a level of refinement and pauses there.
    void step();
    void stop();

    /// What snapshots tell from now on; where the solver rests, a new one follows at once.
    void setDetail(const solve::Detail& detail);
    /// Whether the display's light is to be gathered while the solver rests, what is seen from here first;
    /// nothing for the light as it is solved.
    void setGathering(const std::optional<image::Look>& look);
    /// Asks what is met along a ray. Answered after the next sweep, or at once where the solver rests; a
    /// later question takes the place of one that still waits.
    void ask(const rays::Ray& ray);
    /// The newest answer; null before the first.
    std::shared_ptr<const Finding> finding() const;

    /// Asks for a still of the solution. Taken after a sweep, once there is a level of refinement and the
    /// light hardly changes any more, or at once where the solver rests; the solver goes on afterwards to the
    /// same bits, and the time does not count. Takes the place of one that is not over, which is cancelled.
    /// Options that come meanwhile wait; questions are answered.
    void take(std::shared_ptr<StillJob> still);

    /// Waits until the session is finished, stopped or failed.
    Status wait();

  private:
    void run();
    void solveOnce(std::unique_lock<std::mutex>& lock);
    solve::Callbacks makeCallbacks();
    void enter(std::unique_lock<std::mutex>& lock, Phase phase);
    void publish(std::shared_ptr<const solve::Snapshot> snapshot);
    void answer(std::unique_lock<std::mutex>& lock);
    void look(std::unique_lock<std::mutex>& lock);
    void serveStill(std::unique_lock<std::mutex>& lock);
    bool mayGather() const { return look_ && !isGathered_ && solved_ != nullptr && solving_.look.gather; }
    void gather(std::unique_lock<std::mutex>& lock);

    const Solving solving_;
    const std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    // All below are guarded by mutex_.
    solve::Options options_;
    std::shared_ptr<const solve::Snapshot> latest_;
    Status status_;
    solve::Detail detail_;
    bool hasNewDetail_ = false;
    std::optional<image::Look> look_;  ///< while light is to be gathered
    bool isGathered_ = false;
    /// The newest snapshot as the solver made it.
    std::shared_ptr<const solve::Snapshot> solved_;
    std::optional<rays::Ray> question_;
    std::shared_ptr<const Finding> finding_;
    /// The one that waits, or is being made.
    std::shared_ptr<StillJob> still_;
    bool hasSolved_ = false;
    bool hasNewOptions_ = true;
    bool needsNewSolver_ = false;
    bool isUnfinished_ = true;
    bool isPaused_ = false;
    bool isStopping_ = false;
    std::thread thread_;
};

}  // namespace fluxwalk::session
