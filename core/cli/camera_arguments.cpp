#include "core/cli/camera_arguments.h"

#include <CLI/App.hpp>

#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/cli/values.h"
#include "core/scene/camera_path.h"
#include "core/scene/look_at.h"

namespace fluxwalk::cli {
namespace {

constexpr double kDefaultFov = 50.0;
constexpr double kLeastFov = 1.0;
constexpr double kLargestFov = 179.0;

scene::Camera findCamera(const std::string& name, const scene::Scene& scene) {
    std::string known;
    for (const scene::Camera& camera : scene.cameras) {
        if (camera.name == name) {
            return camera;
        }
        known += (known.empty() ? "" : ", ") + camera.name;
    }
    throw base::UsageError("--camera: the scene has no camera '" + name + "'" +
                           (known.empty() ? "" : "; it has " + known));
}

base::Vec3d toVector(const std::vector<double>& values) {
    return {values[0], values[1], values[2]};
}

}  // namespace

void addCameraOptions(CLI::App& app, CameraArguments& arguments) {
    CLI::Option* name = app.add_option("--camera", arguments.name, "Camera of the scene to look from.");
    name->type_name("NAME")->group("Camera");
    const auto addPoint = [&](const char* option, std::vector<double>& point, const char* description) {
        return app.add_option(option, point, description)
            ->delimiter(',')
            ->expected(3)
            ->type_name("X,Y,Z")
            ->excludes(name)
            ->group("Camera");
    };
    CLI::Option* eye = addPoint("--eye", arguments.eye, "Where to look from, in metres.");
    CLI::Option* target = addPoint("--target", arguments.target, "Where to look, in metres.");
    eye->needs(target);
    target->needs(eye);
    app.add_option_function<std::string>(
           "--fov",
           [&arguments](const std::string& text) {
               arguments.fov = parseNumberOption("--fov", text, kLeastFov, kLargestFov, "degrees");
           },
           "Vertical field of view in degrees; by default the camera's own, or 50 with --eye.")
        ->type_name("DEG")
        ->group("Camera");
}

scene::Camera chooseCamera(const CameraArguments& arguments, const scene::Scene& scene,
                           const std::function<scene::Camera()>& firstView) {
    scene::Camera camera;
    if (!arguments.eye.empty()) {
        camera = scene::lookAt(toVector(arguments.eye), toVector(arguments.target),
                               arguments.fov > 0.0 ? arguments.fov : kDefaultFov);
    } else if (!arguments.name.empty()) {
        camera = findCamera(arguments.name, scene);
    } else {
        const bool hasSound = !scene.cameras.empty() && !scene::findFault(scene.cameras.front());
        camera = hasSound ? scene.cameras.front() : firstView();
    }
    if (arguments.fov > 0.0) {
        camera.verticalFov = arguments.fov * base::kPi / 180.0;
    }
    if (const auto fault = scene::findFault(camera)) {
        throw base::UsageError("the camera " + (camera.name.empty() ? *fault : camera.name + " " + *fault));
    }
    return camera;
}

}  // namespace fluxwalk::cli
