#include "core/cli/solver_arguments.h"

#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/cli/values.h"
#include "core/solve/options_table.h"

namespace fluxwalk::cli {

namespace {

constexpr unsigned kMostThreads = 1024;
constexpr double kLongestInterval = 1e9;  ///< seconds

std::string typeName(const solve::OptionInfo& option) {
    switch (option.kind) {
        case solve::OptionKind::fraction:
            return "PERCENT%";
        case solve::OptionKind::choice:
            return "NAME";
        case solve::OptionKind::integer:
            return "N";
        case solve::OptionKind::bytes:
            return "BYTES";
        default:
            break;
    }
    std::string name(option.unit);
    for (char& c : name) {
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return name;
}

// Commands may have defaults of their own.
std::string describe(const solve::OptionInfo& option, const solve::Options& defaults) {
    return fmt::format("{} Default {}; {}.", option.explanation,
                       solve::formatOption(option, option.get(defaults)), solve::describeRange(option));
}

void set(SolverArguments& arguments, const solve::OptionInfo& option, double value) {
    option.set(arguments.options, value);
    arguments.typed.emplace_back(&option, value);
}

void addCheckpointOptions(CLI::App& app, SolverArguments& arguments) {
    app.add_option("--checkpoint", arguments.checkpoint,
                   "Keep the state of the solve in this file: after each level of refinement, at intervals "
                   "within, and before a stop. Written beside and renamed, so that a crash or a full disk "
                   "leaves the one before. HDF5, readable from Python.")
        ->type_name("FILE")
        ->group("Solver");
    app.add_option_function<std::string>(
           "--checkpoint-interval",
           [&arguments](const std::string& text) {
               arguments.checkpointInterval =
                   parseNumberOption("--checkpoint-interval", text, 0.0, kLongestInterval, "s");
           },
           fmt::format("Time between checkpoints within a level. Default {:g} s; 0 keeps one after every "
                       "wave of links.",
                       arguments.checkpointInterval))
        ->type_name("S")
        ->group("Solver");
    app.add_option("--resume", arguments.resume,
                   "Go on from a checkpoint of the same SCENE (and --sky), to the same bits as a solve that "
                   "was not interrupted. Its options hold unless they are typed anew; --seed, --clusters, "
                   "--cluster-model and --rays cannot change, --time-limit counts anew, and --memory-limit "
                   "is the machine's.")
        ->type_name("FILE")
        ->group("Solver");
}

}  // namespace

void addSolverOptions(CLI::App& app, SolverArguments& arguments) {
    for (const solve::OptionInfo& option : solve::optionsTable()) {
        const std::string name = "--" + std::string(option.name);
        if (option.kind == solve::OptionKind::flag) {
            app.add_flag_callback(
                   name, [&arguments, &option] { set(arguments, option, 1.0); },
                   std::string(option.explanation) + " Off by default.")
                ->group("Solver");
            continue;
        }
        app.add_option_function<std::string>(
               name,
               [&arguments, &option](const std::string& text) {
                   set(arguments, option, solve::parseOption(option, text));
               },
               describe(option, arguments.options))
            ->type_name(typeName(option))
            ->group("Solver");
    }
    app.add_option_function<std::string>(
           "--threads",
           [&arguments](const std::string& text) {
               arguments.threads = parseCountOption("--threads", text, 0, kMostThreads);
           },
           "Threads to work on; the result does not depend on it. Default 0: all that the machine has.")
        ->type_name("N")
        ->group("Solver");
    app.add_option_function<std::vector<std::string>>(
           "--light",
           [&arguments](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   arguments.lights.push_back(parseTurnedLight(text));
               }
           },
           "Switch, dim or recolour what shines: a material or light by its name, or sky. A factor on what "
           "the "
           "scene says, or three for red, green and blue: lamp=0, lamp=0.4, lamp=1,0.7,0.4. May be repeated. "
           "With --resume the light follows over the links that stand.")
        ->type_name("NAME=FACTOR")
        ->take_all()
        ->group("Solver");
    addCheckpointOptions(app, arguments);
}

void addOutputOptions(CLI::App& app, OutputArguments& arguments) {
    app.add_option("--report", arguments.report,
                   "Write counters, stage times, audit and achieved error to this file as JSON.")
        ->type_name("FILE.json")
        ->group("Output");
    app.add_flag("--json", arguments.json, "Print the report as JSON on standard output.")->group("Output");
    app.add_flag("--quiet", arguments.quiet, "Print errors only.")->group("Output");
}

}  // namespace fluxwalk::cli
