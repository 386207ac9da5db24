#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/scene/scene.h"

/// Built-in scenes as code: one registry for commands, tests and benchmarks.
namespace fluxwalk::scene {

struct BuiltInScene {
    std::string_view name;         ///< as typed by the user, "cornell-box"
    std::string_view description;  ///< one line for `fluxwalk info --list`
    Scene (*build)();
};

std::span<const BuiltInScene> builtInScenes();
std::optional<Scene> buildScene(std::string_view name);

}  // namespace fluxwalk::scene
