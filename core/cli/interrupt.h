#pragma once

#include <array>
#include <csignal>

namespace fluxwalk::cli {

/// While it lives, the first Ctrl-C (or SIGTERM) only asks to stop; the second ends the program as usual. One
/// at a time: signals belong to the process.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    /// Whether a stop was asked for since this was made; may be called from any thread.
    static bool isRequested();

  private:
    std::array<struct sigaction, 2> previous_{};
};

}  // namespace fluxwalk::cli
