#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "core/cli/solver_arguments.h"
#include "core/solve/solver.h"

namespace fluxwalk::cli {

/// Where a solve starts and where its state is kept, as --resume and --checkpoint say.
class Checkpointing {
  public:
    /// Reads the checkpoint to be resumed. Throws WriteError where none could be kept, base::FileError where
    /// that of --resume is bad.
    explicit Checkpointing(const SolverArguments& arguments);

    /// As typed, over those of the resumed checkpoint.
    const solve::Options& options() const { return options_; }

    /// A new solver, or one that goes on. Once only. Throws base::FileError.
    std::unique_ptr<solve::Solver> makeSolver(std::shared_ptr<const scene::Scene> scene,
                                              const solve::Options& options, unsigned threads);

    /// For Callbacks::resumable: keeps the solver's state, but between waves only when it is time. What goes
    /// wrong is a warning, and the file stays as it was.
    void keep(const solve::Solver& solver, solve::Moment moment);

    /// After a solve: warns where it ended before there was anything to keep.
    void finish() const;

  private:
    std::filesystem::path file_;
    std::filesystem::path resumed_;
    std::optional<base::NamedArrays> start_;
    solve::Options options_;
    using Clock = std::chrono::steady_clock;
    Clock::duration interval_;
    Clock::time_point kept_ = Clock::now();
    bool isAsked_ = false;  ///< there was something to keep
};

}  // namespace fluxwalk::cli
