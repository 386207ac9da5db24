#pragma once

#include <chrono>
#include <span>

#include "core/solve/checkpoint.h"
#include "core/solve/publisher.h"

namespace fluxwalk::solve {

/// One call of Solver::solve: its clock, its stops and whom it tells.
class Run {
    using Clock = std::chrono::steady_clock;

  public:
    Run(Problem& problem, const Callbacks& callbacks, LoopState& loop, Publisher& publisher);

    /// Asked between waves and sweeps: takes new options over, tells that the solve could go on from here,
    /// and returns whether what is at work shall end.
    bool isStopped();
    /// The same within a wave, for what need not wait for its end: new options are taken over and a picture
    /// of what there is by then is published when it is time.
    bool isCalledAway(std::span<const Decision> underway);
    /// Whether a stop or the time limit has been seen.
    bool isCut() const { return wasStopped_ || isOutOfTime_; }
    /// Whether the level at hand was left for what new options ask for; forgets it.
    bool takeTurn();
    /// Whether the lights are to be turned; what is at work ends for that too.
    bool wantsRelight() const;
    /// The next snapshot need not wait for its time.
    void hurry() { isHurried_ = true; }
    /// Its time has come.
    void makeDue() { due_ = Clock::now(); }

    /// Sweeps, `most` times in all, until one changes no more than `residual` of the power.
    void sweep(int most, double residual);
    void audit(std::size_t rays);
    void publish(bool isFinished);
    void report(const char* stage);
    /// Tells of a finished level.
    void finishLevel();
    /// From here on new options wait, and nothing is told any more that the solve could go on from.
    void beginLastSweeps();

    double seconds() const;
    Outcome outcome(Limit limit) const;

  private:
    void takeNewOptions();
    /// Lets others look at the solution; their time is not the solve's.
    void settle();
    bool isTimeToPublish() const;
    void deliver(bool isFinished);
    /// Puts the next snapshot off after one that took so many seconds.
    void rest(double publishTime);
    void tell(Moment moment);

    Problem& problem_;
    const Callbacks& callbacks_;
    LoopState& loop_;
    Publisher& publisher_;
    double before_;
    Clock::time_point start_ = Clock::now();  ///< later by the time of those who looked
    Clock::time_point due_;                   ///< of the next snapshot
    bool wasStopped_ = false;
    bool isOutOfTime_ = false;
    bool isTurned_ = false;
    bool isHurried_ = false;
    bool isResumable_ = true;
};

}  // namespace fluxwalk::solve
