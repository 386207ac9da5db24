#pragma once

#include <filesystem>

#include "core/solve/options.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// How to solve, from the table in core/solve/options_table.h, and on how many threads.
struct SolverArguments {
    solve::Options options;
    unsigned threads = 0;  ///< 0: all that the machine has
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
