#pragma once

#include "core/cli/command.h"

namespace fluxwalk::app {

/// `view`: walks through a scene while it is solved, or through a lit file; or writes a picture of it.
cli::Command viewCommand();

}  // namespace fluxwalk::app
