#include "core/cli/checkpointing.h"

#include "core/base/error.h"
#include "core/cli/output.h"
#include "core/io/array_file.h"
#include "core/solve/checkpoint.h"

namespace fluxwalk::cli {

Checkpointing::Checkpointing(const SolverArguments& arguments)
    : file_(arguments.checkpoint),
      resumed_(arguments.resume),
      options_(arguments.options),
      interval_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(arguments.checkpointInterval))) {
    if (!file_.empty()) {
        requireWritable(file_);
    }
    if (resumed_.empty()) {
        return;
    }
    start_ = io::readArrayFile(resumed_);
    options_ = solve::storedOptions(*start_, arguments.options, resumed_.string());
    for (const auto& [option, value] : arguments.typed) {
        option->set(options_, value);
    }
}

std::unique_ptr<solve::Solver> Checkpointing::makeSolver(std::shared_ptr<const scene::Scene> scene,
                                                         const solve::Options& options, unsigned threads) {
    auto solver = std::make_unique<solve::Solver>(std::move(scene), options, threads);
    if (start_) {
        solver->restore(*start_, resumed_.string());
        start_.reset();
        // Where nothing is left to do, no level will be finished.
        if (file_ != resumed_) {
            keep(*solver, solve::Moment::level);
        }
    }
    return solver;
}

void Checkpointing::keep(const solve::Solver& solver, solve::Moment moment) {
    if (file_.empty() || (moment == solve::Moment::wave && Clock::now() - kept_ < interval_)) {
        return;
    }
    try {
        isAsked_ = true;
        io::writeArrayFile(file_, solver.checkpoint());
    } catch (const base::FileError& error) {
        printWarning(std::string("the checkpoint was not kept: ") + error.what());
    }
    kept_ = Clock::now();
}

void Checkpointing::finish() const {
    if (!file_.empty() && !isAsked_) {
        printWarning(file_.string() + ": stopped before there was anything to keep");
    }
}

}  // namespace fluxwalk::cli
