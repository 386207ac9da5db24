#pragma once

#include <filesystem>
#include <optional>

namespace fluxwalk::app {

/// Where the program keeps what is the user's: $XDG_STATE_HOME/fluxwalk, or ~/.local/state/fluxwalk. Nothing
/// where the environment names neither by an absolute path.
std::optional<std::filesystem::path> findStateFolder();

}  // namespace fluxwalk::app
