#pragma once

#include "core/cli/command.h"

namespace fluxwalk::cli {

Command solveCommand();
Command measureCommand();
Command verifyCommand();
Command infoCommand();

}  // namespace fluxwalk::cli
