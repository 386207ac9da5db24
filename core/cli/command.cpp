#include "core/cli/command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <new>

#include <CLI/CLI.hpp>

#include "core/cli/help_formatter.h"
#include "core/cli/output.h"
#include "core/cli/suggest.h"
#include "core/scene/builders.h"

namespace fluxwalk::cli {

namespace {

constexpr const char* kDescription =
    "Hierarchical radiosity on exact objects: solves the diffuse light of a scene and lets you walk through "
    "it.\n"
    "SCENE is a .glb or .gltf file or the name of a built-in scene (fluxwalk info --list).";

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0    done\n"
    "  1    an error of the program itself\n"
    "  2    an option or value makes no sense\n"
    "  3    a file could not be read or understood\n"
    "  4    a result could not be written\n"
    "  130  stopped by Ctrl-C; what was solved by then has been written";

using Run = std::function<ExitCode()>;

std::vector<std::string> namesOf(const std::vector<Command>& commands) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const Command& command : commands) {
        names.push_back(command.name);
    }
    return names;
}

/// Whether a word can only be meant as a command: it names no file and no scene, and looks like no file name.
bool isNoScene(const std::string& word) {
    std::error_code ignored;
    return word.find_first_of("./\\") == std::string::npos && !std::filesystem::exists(word, ignored) &&
           !scene::isBuiltInScene(word);
}

/// Puts the default command's name in front unless a command is named. The first word counts, or the first
/// one after the options where there is none: `fluxwalk --error 5% room.glb` views.
void insertDefaultCommand(std::vector<std::string>& args, const std::vector<Command>& commands) {
    const std::string& first = args.front();
    if (first == "-h" || first == "--help" || first == "--version") {
        return;
    }
    const std::vector<std::string> names = namesOf(commands);
    if (std::find(names.begin(), names.end(), first) != names.end()) {
        return;
    }
    if (!first.starts_with('-') && isNoScene(first)) {
        const std::string suggestion = didYouMean(first, names);
        if (!suggestion.empty()) {
            throw base::UsageError("unknown command '" + first + "'" + suggestion);
        }
    }
    args.insert(args.begin(), names.front());
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

/// One line about what is wrong. A mistyped option is named even where another complaint came first, as it is
/// usually the cause.
std::string explain(const CLI::ParseError& error, const CLI::App& app) {
    const std::vector<const CLI::App*> chosen = app.get_subcommands(nullptr);
    const CLI::App* command = &app;
    for (const CLI::App* candidate : chosen) {
        command = candidate->parsed() ? candidate : command;
    }
    const std::vector<std::string> rest = command->remaining();
    for (const std::string& word : rest) {
        if (word.starts_with('-')) {
            const std::string name = word.substr(0, word.find('='));
            return "unknown option '" + name + "'" + didYouMean(name, optionNames(*command));
        }
    }
    if (!rest.empty()) {
        return "unexpected '" + rest.front() + "' after the arguments of " + command->get_name();
    }
    return error.what();
}

std::unique_ptr<CLI::App> makeApp(const std::vector<Command>& commands, std::map<std::string, Run>& runs) {
    auto app = std::make_unique<CLI::App>(kDescription, "fluxwalk");
    app->formatter(std::make_shared<HelpFormatter>());
    app->set_help_flag("-h,--help", "Show this help; after a command, the help of that command.");
    app->set_version_flag("--version", "fluxwalk " FLUXWALK_VERSION, "Show the version.");
    app->require_subcommand(0, 1);
    std::string footer = "Without a command, '" + commands.front().name + "' is meant. ";
    footer += "'fluxwalk COMMAND --help' explains a command's options.\n\n";
    app->footer(footer + kExitCodes);
    for (const Command& command : commands) {
        CLI::App* sub = app->add_subcommand(command.name, command.description);
        sub->footer("");
        sub->group("Commands");
        runs[command.name] = command.declare(*sub);
    }
    return app;
}

ExitCode dispatch(std::vector<std::string> args, const std::vector<Command>& commands) {
    std::map<std::string, Run> runs;
    const std::unique_ptr<CLI::App> app = makeApp(commands, runs);
    if (args.empty()) {
        printText(app->help());
        return ExitCode::success;
    }
    insertDefaultCommand(args, commands);
    // CLI11 takes its arguments from the back.
    std::reverse(args.begin(), args.end());
    try {
        app->parse(std::move(args));
    } catch (const CLI::CallForHelp&) {
        printText(app->help());
        return ExitCode::success;
    } catch (const CLI::CallForVersion& version) {
        printText(std::string(version.what()) + "\n");
        return ExitCode::success;
    } catch (const CLI::ParseError& error) {
        throw base::UsageError(explain(error, *app));
    }
    return runs.at(app->get_subcommands().front()->get_name())();
}

int fail(ExitCode code, const char* message) {
    std::fprintf(stderr, "fluxwalk: error: %s\n", message);
    return static_cast<int>(code);
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const std::vector<Command>& commands) {
    try {
        return static_cast<int>(dispatch({argv + 1, argv + argc}, commands));
    } catch (const base::UsageError& error) {
        return fail(ExitCode::usage, error.what());
    } catch (const WriteError& error) {
        return fail(ExitCode::cannotWrite, error.what());
    } catch (const base::FileError& error) {
        return fail(ExitCode::badInput, error.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::bug, "out of memory");
    } catch (const std::exception& error) {
        return fail(ExitCode::bug, error.what());
    }
}

}  // namespace fluxwalk::cli
