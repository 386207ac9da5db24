#pragma once

#include "core/cli/command.h"

namespace fluxwalk::app {

/// `render`: solves a scene and takes a still of it by final gathering.
cli::Command renderCommand();

}  // namespace fluxwalk::app
