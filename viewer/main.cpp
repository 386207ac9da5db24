#include "core/cli/command.h"
#include "viewer/app/render_command.h"
#include "viewer/app/view_command.h"

int main(int argc, char** argv) {
    std::vector<fluxwalk::cli::Command> commands{fluxwalk::app::viewCommand(),
                                                 fluxwalk::app::renderCommand()};
    for (fluxwalk::cli::Command& command : fluxwalk::cli::coreCommands()) {
        commands.push_back(std::move(command));
    }
    return fluxwalk::cli::runCommandLine(argc, argv, commands);
}
