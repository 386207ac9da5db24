#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/cli/core_commands.h"
#include "core/cli/output.h"
#include "core/cli/report.h"
#include "core/cli/scene_arguments.h"
#include "core/scene/builders.h"
#include "core/scene/texture.h"

namespace fluxwalk::cli {

namespace {

struct InfoArguments {
    SceneArguments scene;
    bool list = false;
    bool json = false;
};

std::string listScenes(bool asJson) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    std::string text;
    for (const scene::BuiltInScene& builtIn : scene::builtInScenes()) {
        json.push_back({{"name", builtIn.name}, {"description", builtIn.description}});
        text += fmt::format("{:<24}{}\n", builtIn.name, builtIn.description);
    }
    return asJson ? toText(json) : text;
}

ExitCode runInfo(const InfoArguments& arguments) {
    if (arguments.list) {
        printText(listScenes(arguments.json));
        return ExitCode::success;
    }
    if (arguments.scene.scene.empty()) {
        throw base::UsageError("info: name a scene, or --list for the built-in ones");
    }
    const scene::Scene scene = loadScene(arguments.scene);
    const scene::SceneDescription description = scene::describeScene(scene, scene::TextureSet(scene));
    printText(arguments.json ? toText(toJson(description)) : formatDescription(description));
    return ExitCode::success;
}

}  // namespace

Command infoCommand() {
    return {"info", "Say what was understood of a scene: objects, emitters, areas, units and warnings.",
            [](CLI::App& app) {
                const auto arguments = std::make_shared<InfoArguments>();
                addSceneOptions(app, arguments->scene)->required(false);
                app.add_flag("--list", arguments->list, "List the built-in scenes instead.")->group("Output");
                app.add_flag("--json", arguments->json, "Print JSON.")->group("Output");
                return [arguments] { return runInfo(*arguments); };
            }};
}

}  // namespace fluxwalk::cli
