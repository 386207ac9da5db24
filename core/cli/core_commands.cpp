#include "core/cli/core_commands.h"

namespace fluxwalk::cli {

std::vector<Command> coreCommands() {
    return {solveCommand(), measureCommand(), verifyCommand(), infoCommand()};
}

}  // namespace fluxwalk::cli
