#pragma once

#include <string>

#include "core/scene/scene.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace fluxwalk::cli {

/// Which scene, and under which sky.
struct SceneArguments {
    std::string scene;  ///< a .glb or .gltf file or the name of a built-in scene
    double sky = -1.0;  ///< lux on a horizontal plane; negative: as in the scene
};

/// Declares SCENE (required; returned, so that a command may loosen that) and --sky.
CLI::Option* addSceneOptions(CLI::App& app, SceneArguments& arguments);

/// Whether a word is meant as a file: it looks like one, or one exists.
bool namesFile(const std::string& scene);

/// Reads or builds the scene and gives it its sky. Throws base::FileError, or base::UsageError for an unknown
/// name, which suggests the nearest.
scene::Scene loadScene(const SceneArguments& arguments);

}  // namespace fluxwalk::cli
