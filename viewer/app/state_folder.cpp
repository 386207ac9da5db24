#include "viewer/app/state_folder.h"

#include <cstdlib>

namespace fluxwalk::app {

std::optional<std::filesystem::path> findStateFolder() {
    const auto pathOf = [](const char* variable) {
        const char* value = std::getenv(variable);
        return std::filesystem::path(value != nullptr ? value : "");
    };
    if (const auto state = pathOf("XDG_STATE_HOME"); state.is_absolute()) {
        return state / "fluxwalk";
    }
    if (const auto home = pathOf("HOME"); home.is_absolute()) {
        return home / ".local" / "state" / "fluxwalk";
    }
    return std::nullopt;
}

}  // namespace fluxwalk::app
