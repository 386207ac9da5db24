#include "core/cli/interrupt.h"

#include <atomic>

namespace fluxwalk::cli {

namespace {

constexpr std::array<int, 2> kSignals = {SIGINT, SIGTERM};

// A signal handler can reach nothing but the process's own state.
std::atomic<bool> stopRequested{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "only lock-free atomics may be used in a signal handler");

extern "C" void requestStop(int /*signal*/) {
    stopRequested = true;
}

}  // namespace

Interrupt::Interrupt() {
    stopRequested = false;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        struct sigaction action {};
        action.sa_handler = requestStop;
        // The default action comes back with the first signal, so that a second one ends the program.
        action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
        sigemptyset(&action.sa_mask);
        sigaction(kSignals[i], &action, &previous_[i]);
    }
}

Interrupt::~Interrupt() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        sigaction(kSignals[i], &previous_[i], nullptr);
    }
}

bool Interrupt::isRequested() {
    return stopRequested;
}

}  // namespace fluxwalk::cli
