#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/solve/solver.h"

/// The solver in a thread of its own.
namespace fluxwalk::session {

/// Solves with the given options until done or stopped; called again to go on. Runs on the session's thread.
using SolveFunction = std::function<solve::Outcome(const solve::Options&, const solve::Callbacks&)>;

/// Where its Solver comes from, and who is told when it could go on from its state (may be empty).
struct SolverSource {
    std::function<std::unique_ptr<solve::Solver>(const solve::Options&)> make;
    std::function<void(const solve::Solver&, solve::Moment)> resumable;
};

/// Makes its Solver on the first call and keeps it for the next ones.
SolveFunction solveWith(SolverSource source);

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
    std::exception_ptr failure;
};

/// Owns the solver's thread. Every member may be called from any thread and none waits for the solver, except
/// wait() and the destructor. The solver reacts at its wave boundaries.
class SolverSession {
  public:
    /// Starts at once. `wake` (may be empty) is called on the solver's thread after each new snapshot and
    /// change of phase.
    SolverSession(SolveFunction solve, const solve::Options& options, std::function<void()> wake);
    /// Stops and joins.
    ~SolverSession();
    SolverSession(const SolverSession&) = delete;
    SolverSession& operator=(const SolverSession&) = delete;

    /// The newest snapshot; null before the first.
    std::shared_ptr<const solve::Snapshot> latest() const;
    Status status() const;

    /// Takes effect at the next wave; makes a finished session go on.
    void setOptions(const solve::Options& options);
    solve::Options options() const;
    void setPaused(bool paused);
    void stop();

    /// Waits until the session is finished, stopped or failed.
    Status wait();

  private:
    void run();
    void solveOnce(std::unique_lock<std::mutex>& lock);
    solve::Callbacks makeCallbacks();
    void enter(std::unique_lock<std::mutex>& lock, Phase phase);

    const SolveFunction solve_;
    const std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    // All below are guarded by mutex_.
    solve::Options options_;
    std::shared_ptr<const solve::Snapshot> latest_;
    Status status_;
    bool hasNewOptions_ = true;
    bool isUnfinished_ = true;
    bool isPaused_ = false;
    bool isStopping_ = false;
    std::thread thread_;
};

}  // namespace fluxwalk::session
