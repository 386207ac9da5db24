#pragma once

#include "core/cli/command.h"

namespace fluxwalk::cli {

Command solveCommand();
Command measureCommand();
Command infoCommand();

}  // namespace fluxwalk::cli
