#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The program's commands. Each is a thin function over the layers below; `view` is added by the viewer.
namespace fluxwalk::cli {

/// Exit codes, documented in --help.
enum class ExitCode : int {
    success = 0,
    bug = 1,           ///< an error of the program itself
    usage = 2,         ///< an option or value makes no sense
    badInput = 3,      ///< a file could not be read or understood
    cannotWrite = 4,   ///< a result could not be written
    interrupted = 130  ///< stopped by Ctrl-C; what was solved by then has been written
};

struct Command {
    std::string name;
    std::string description;
    /// Declares its options on `app` and returns what to run after parsing; the return value is the exit
    /// code.
    std::function<std::function<ExitCode()>(CLI::App& app)> declare;
};

/// solve, measure, verify, info.
std::vector<Command> coreCommands();

/// Parses and runs; catches what is thrown and prints one line. `commands[0]` is run when the first word that
/// is no option names no command.
int runCommandLine(int argc, const char* const* argv, const std::vector<Command>& commands);

}  // namespace fluxwalk::cli
