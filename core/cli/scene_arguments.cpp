#include "core/cli/scene_arguments.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/cli/suggest.h"
#include "core/cli/values.h"
#include "core/io/gltf_read.h"
#include "core/io/lit_gltf.h"
#include "core/scene/builders.h"

namespace fluxwalk::cli {

namespace {

constexpr double kLargestSky = 1e6;  // lux; the sun and sky at noon give 1.2e5

scene::Scene buildNamedScene(const std::string& name) {
    std::optional<scene::Scene> scene = scene::buildScene(name);
    if (scene) {
        // Variants of one scene share a builder, not a name.
        scene->name = name;
        return std::move(*scene);
    }
    std::vector<std::string> names;
    for (const scene::BuiltInScene& builtIn : scene::builtInScenes()) {
        names.emplace_back(builtIn.name);
    }
    throw base::UsageError(fmt::format("unknown scene '{}': neither a file nor a built-in scene{}", name,
                                       didYouMean(name, names)));
}

}  // namespace

CLI::Option* addSceneOptions(CLI::App& app, SceneArguments& arguments) {
    app.add_option_function<std::string>(
           "--sky",
           [&arguments](const std::string& text) {
               arguments.sky = parseNumberOption("--sky", text, 0.0, kLargestSky, "lux");
           },
           fmt::format(
               "Light of a uniform sky on an unobstructed horizontal plane, in lux; 0 for none. By default "
               "the scene's own, or {:g} lux where a scene has no light at all.",
               scene::kDefaultSky))
        ->type_name("LUX")
        ->group("Scene");
    return app
        .add_option("SCENE", arguments.scene, "A .glb or .gltf file, or a built-in scene (info --list).")
        ->required();
}

bool namesFile(const std::string& scene) {
    std::string extension = std::filesystem::path(scene).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code ignored;
    return extension == ".glb" || extension == ".gltf" || scene.find('/') != std::string::npos ||
           std::filesystem::exists(scene, ignored);
}

namespace {

// A lit file is read as one, so that its two meshes for the two sides of a surface are one surface again.
scene::Scene readSceneFile(const std::filesystem::path& file) {
    if (!io::isLitGltf(file)) {
        return io::readGltf(file);
    }
    scene::Scene scene = io::readLitGltf(file).scene;
    scene.warnings.emplace_back(
        "a lit file: its displayed triangles are the scene now; the original solves better");
    return scene;
}

}  // namespace

scene::Scene loadScene(const SceneArguments& arguments) {
    scene::Scene scene =
        namesFile(arguments.scene) ? readSceneFile(arguments.scene) : buildNamedScene(arguments.scene);
    if (arguments.sky >= 0.0) {
        scene.sky = scene::Rgb(static_cast<float>(arguments.sky));
    } else {
        scene::applyDefaultSky(scene);
    }
    return scene;
}

}  // namespace fluxwalk::cli
