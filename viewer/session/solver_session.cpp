#include "viewer/session/solver_session.h"

#include <utility>

namespace fluxwalk::session {

SolverSession::SolverSession(SolveFunction solve, const solve::Options& options, std::function<void()> wake)
    : solve_(std::move(solve)), wake_(std::move(wake)), options_(options), thread_([this] { run(); }) {}

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
    changed_.notify_all();
}

void SolverSession::stop() {
    const std::lock_guard lock(mutex_);
    isStopping_ = true;
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

solve::Callbacks SolverSession::makeCallbacks() {
    solve::Callbacks callbacks;
    callbacks.publish = [this](std::shared_ptr<const solve::Snapshot> snapshot) {
        {
            const std::lock_guard lock(mutex_);
            // Swapped, so that the old one is freed after the lock.
            std::swap(latest_, snapshot);
        }
        if (wake_) {
            wake_();
        }
    };
    callbacks.shouldStop = [this] {
        const std::lock_guard lock(mutex_);
        return isStopping_ || isPaused_;
    };
    callbacks.newOptions = [this]() -> std::optional<solve::Options> {
        const std::lock_guard lock(mutex_);
        return std::exchange(hasNewOptions_, false) ? std::optional(options_) : std::nullopt;
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
    const solve::Options options = options_;
    lock.unlock();
    const solve::Outcome outcome = solve_(options, makeCallbacks());
    lock.lock();
    status_.outcome = outcome;
    isUnfinished_ = outcome == solve::Outcome::stopped;
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
            enter(lock, hasWork ? Phase::paused : Phase::finished);
            changed_.wait(
                lock, [this] { return isStopping_ || (!isPaused_ && (isUnfinished_ || hasNewOptions_)); });
        }
        enter(lock, Phase::stopped);
    } catch (...) {
        if (!lock.owns_lock()) {
            lock.lock();
        }
        status_.failure = std::current_exception();
        enter(lock, Phase::failed);
    }
}

}  // namespace fluxwalk::session
