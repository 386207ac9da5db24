#include "core/cli/checkpointing.h"

#include "core/base/error.h"
#include "core/cli/output.h"
#include "core/io/array_file.h"
#include "core/solve/checkpoint.h"

namespace fluxwalk::cli {

Checkpointing::Checkpointing(const SolverArguments& arguments)
    : file_(arguments.checkpoint), resumed_(arguments.resume), options_(arguments.options) {
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
            keep(*solver);
        }
    }
    return solver;
}

void Checkpointing::keep(const solve::Solver& solver) {
    if (file_.empty()) {
        return;
    }
    try {
        isAsked_ = true;
        io::writeArrayFile(file_, solver.checkpoint());
    } catch (const base::FileError& error) {
        printWarning(std::string("the checkpoint was not kept: ") + error.what());
    }
}

void Checkpointing::finish() const {
    if (!file_.empty() && !isAsked_) {
        printWarning(file_.string() + ": stopped within the first level: there is no checkpoint to keep yet");
    }
}

}  // namespace fluxwalk::cli
