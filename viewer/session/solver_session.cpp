#include "viewer/session/solver_session.h"

#include <utility>

#include "core/solve/turn.h"

namespace fluxwalk::session {

SolverSession::SolverSession(Solving solving, const solve::Options& options, std::function<void()> wake)
    : solving_(std::move(solving)), wake_(std::move(wake)), options_(options), thread_([this] { run(); }) {}

SolverSession::~SolverSession() {
    stop();
    thread_.join();
}

std::shared_ptr<const solve::Snapshot> SolverSession::latest() const {
    const std::lock_guard lock(mutex_);
    return latest_;
}

Status SolverSession::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

solve::Options SolverSession::options() const {
    const std::lock_guard lock(mutex_);
    return options_;
}

void SolverSession::setOptions(const solve::Options& options) {
    const std::lock_guard lock(mutex_);
    needsNewSolver_ = needsNewSolver_ || solve::needsNewSolver(options_, options);
    options_ = options;
    hasNewOptions_ = true;
    // From here on wait() means the end of what is asked now.
    if (status_.phase == Phase::finished) {
        status_.phase = isPaused_ ? Phase::paused : Phase::solving;
    }
    changed_.notify_all();
}

void SolverSession::setPaused(bool paused) {
    const std::lock_guard lock(mutex_);
    isPaused_ = paused;
    status_.isStepping = false;
    changed_.notify_all();
}

void SolverSession::step() {
    const std::lock_guard lock(mutex_);
    isPaused_ = false;
    status_.isStepping = true;
    changed_.notify_all();
}

void SolverSession::stop() {
    const std::lock_guard lock(mutex_);
    isStopping_ = true;
    if (still_) {
        still_->cancel();
    }
    changed_.notify_all();
}

void SolverSession::setDetail(const solve::Detail& detail) {
    const std::lock_guard lock(mutex_);
    hasNewDetail_ = hasNewDetail_ || !(detail == detail_);
    detail_ = detail;
    changed_.notify_all();
}

void SolverSession::setGathering(const std::optional<image::Look>& look) {
    {
        const std::lock_guard lock(mutex_);
        const bool isTurned = look.has_value() != look_.has_value();
        look_ = look;
        if (!isTurned) {
            return;
        }
        isGathered_ = false;
        status_.gathered = {};
        if (!look && solved_ != nullptr) {
            latest_ = solved_;
        }
        changed_.notify_all();
    }
    if (wake_) {
        wake_();
    }
}

void SolverSession::ask(const rays::Ray& ray) {
    const std::lock_guard lock(mutex_);
    question_ = ray;
    changed_.notify_all();
}

std::shared_ptr<const Finding> SolverSession::finding() const {
    const std::lock_guard lock(mutex_);
    return finding_;
}

void SolverSession::take(std::shared_ptr<StillJob> still) {
    const std::lock_guard lock(mutex_);
    if (still_) {
        still_->cancel();
    }
    still_ = std::move(still);
    if (isStopping_ || status_.phase == Phase::failed) {
        still_->cancel();
    }
    changed_.notify_all();
}

Status SolverSession::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return status_.phase != Phase::solving && status_.phase != Phase::paused; });
    return status_;
}

void SolverSession::enter(std::unique_lock<std::mutex>& lock, Phase phase) {
    status_.phase = phase;
    changed_.notify_all();
    if (wake_) {
        lock.unlock();
        wake_();
        lock.lock();
    }
}

void SolverSession::publish(std::shared_ptr<const solve::Snapshot> snapshot) {
    {
        const std::lock_guard lock(mutex_);
        solved_ = snapshot;
        isGathered_ = false;
        status_.gathered = {};
        // Swapped, so that the old one is freed after the lock.
        std::swap(latest_, snapshot);
    }
    if (wake_) {
        wake_();
    }
}

// Answers the question that waits, if there is one.
void SolverSession::answer(std::unique_lock<std::mutex>& lock) {
    if (!question_) {
        return;
    }
    auto finding = std::make_shared<Finding>();
    finding->ray = *std::exchange(question_, std::nullopt);
    lock.unlock();
    if (solving_.look.inspect) {
        finding->inspection = solving_.look.inspect(finding->ray);
    }
    lock.lock();
    finding_ = std::move(finding);
    if (wake_) {
        lock.unlock();
        wake_();
        lock.lock();
    }
}

// Makes the still that is asked for.
void SolverSession::serveStill(std::unique_lock<std::mutex>& lock) {
    const std::shared_ptr<StillJob> still = still_;
    if (!still) {
        return;
    }
    lock.unlock();
    still->run(solving_.look.takeStill, [this] {
        std::unique_lock between(mutex_);
        answer(between);
    });
    lock.lock();
    if (still_ == still) {
        still_.reset();
    }
    if (wake_) {
        lock.unlock();
        wake_();
        lock.lock();
    }
}

// What the resting solver is asked to show or to answer.
void SolverSession::look(std::unique_lock<std::mutex>& lock) {
    answer(lock);
    if (std::exchange(hasNewDetail_, false) && solving_.look.show) {
        const solve::Detail detail = detail_;
        lock.unlock();
        auto snapshot = solving_.look.show(detail);
        lock.lock();
        const bool isOfGathered = look_ && solving_.look.gather && snapshot != nullptr;
        if (isOfGathered) {
            // The light that is shown stays: it comes with the detail from the next step.
            solved_ = std::move(snapshot);
            isGathered_ = false;
        } else if (snapshot != nullptr) {
            lock.unlock();
            publish(std::move(snapshot));
            lock.lock();
        }
    }
    if (hasSolved_) {
        serveStill(lock);
    }
}

// A moment's work on the display's light.
void SolverSession::gather(std::unique_lock<std::mutex>& lock) {
    const image::Look look = *look_;
    const std::shared_ptr<const solve::Snapshot> solved = solved_;
    lock.unlock();
    GatherStep step = solving_.look.gather(look, solved);
    lock.lock();
    if (!look_ || solved != solved_) {
        return;
    }
    status_.gathered = step.progress;
    isGathered_ = step.isFinished;
    if (step.snapshot != nullptr) {
        // Swapped, so that the old one is freed after the lock.
        std::swap(latest_, step.snapshot);
    }
    if (wake_) {
        lock.unlock();
        wake_();
        lock.lock();
    }
}

solve::Callbacks SolverSession::makeCallbacks() {
    solve::Callbacks callbacks;
    callbacks.publish = [this](std::shared_ptr<const solve::Snapshot> snapshot) {
        publish(std::move(snapshot));
    };
    callbacks.detail = [this] {
        const std::lock_guard lock(mutex_);
        hasNewDetail_ = false;
        return detail_;
    };
    callbacks.settled = [this] {
        std::unique_lock lock(mutex_);
        answer(lock);
        if (still_ && solving_.look.isFitForStill && solving_.look.isFitForStill()) {
            serveStill(lock);
        }
    };
    callbacks.resumable = [this](solve::Moment moment) {
        const std::lock_guard lock(mutex_);
        if (moment == solve::Moment::level && status_.isStepping) {
            status_.isStepping = false;
            isPaused_ = true;
        }
    };
    callbacks.shouldStop = [this] {
        const std::lock_guard lock(mutex_);
        return isStopping_ || isPaused_ || needsNewSolver_;
    };
    callbacks.newOptions = [this]() -> std::optional<solve::Options> {
        const std::lock_guard lock(mutex_);
        const bool isTaken = hasNewOptions_ && !needsNewSolver_;
        hasNewOptions_ = hasNewOptions_ && !isTaken;
        return isTaken ? std::optional(options_) : std::nullopt;
    };
    callbacks.progress = [this](double progress, const char* stage) {
        const std::lock_guard lock(mutex_);
        status_.progress = progress;
        status_.stage = stage;
    };
    return callbacks;
}

void SolverSession::solveOnce(std::unique_lock<std::mutex>& lock) {
    enter(lock, Phase::solving);
    hasNewOptions_ = false;
    needsNewSolver_ = false;
    const solve::Options options = options_;
    lock.unlock();
    const solve::Outcome outcome = solving_.solve(options, makeCallbacks());
    lock.lock();
    status_.outcome = outcome;
    hasSolved_ = true;
    isUnfinished_ = outcome == solve::Outcome::stopped;
    status_.isStepping = status_.isStepping && isUnfinished_;
}

void SolverSession::run() {
    std::unique_lock lock(mutex_);
    try {
        while (!isStopping_) {
            const bool hasWork = isUnfinished_ || hasNewOptions_;
            if (hasWork && !isPaused_) {
                solveOnce(lock);
                continue;
            }
            if (const Phase rest = hasWork ? Phase::paused : Phase::finished; status_.phase != rest) {
                enter(lock, rest);
            }
            changed_.wait(lock, [this] {
                return isStopping_ || hasNewDetail_ || question_ || (still_ && hasSolved_) || mayGather() ||
                       (!isPaused_ && (isUnfinished_ || hasNewOptions_));
            });
            look(lock);
            if (mayGather() && !isStopping_) {
                gather(lock);
            }
        }
        enter(lock, Phase::stopped);
    } catch (...) {
        if (!lock.owns_lock()) {
            lock.lock();
        }
        status_.failure = std::current_exception();
        if (still_) {
            still_->cancel();
        }
        enter(lock, Phase::failed);
    }
}

}  // namespace fluxwalk::session
