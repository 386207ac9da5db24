#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "core/cli/light_arguments.h"
#include "core/solve/options_table.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// How to solve, from the table in core/solve/options_table.h, and on how many threads.
struct SolverArguments {
    solve::Options options;
    /// What was typed, in order: it goes before what a resumed checkpoint says.
    std::vector<std::pair<const solve::OptionInfo*, double>> typed;
    /// Lights as typed, in order; over those of a resumed checkpoint too.
    std::vector<TurnedLight> lights;
    std::filesystem::path checkpoint;  ///< the state of the solve is kept here, empty for nowhere
    double checkpointInterval = 60.0;  ///< seconds between two of them within a level
    std::filesystem::path resume;      ///< the solve goes on from this checkpoint, empty for a new one
    unsigned threads = 0;              ///< 0: all that the machine has
};

/// What to tell and where.
struct OutputArguments {
    std::filesystem::path report;  ///< JSON report, empty for none
    bool json = false;             ///< the report to standard output, in place of the summary
    bool quiet = false;            ///< errors only
};

void addSolverOptions(CLI::App& app, SolverArguments& arguments);
void addOutputOptions(CLI::App& app, OutputArguments& arguments);

}  // namespace fluxwalk::cli
