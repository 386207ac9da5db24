#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/rays/ray_scene.h"
#include "core/scene/scene.h"
#include "core/scene/sensor.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// From where a picture of differences is taken, as typed.
struct ViewArguments {
    std::string camera;
    std::vector<double> eye;     ///< metres, empty or 3
    std::vector<double> target;  ///< metres, empty or 3
    std::uint32_t width = 320;
    std::uint32_t height = 240;

    bool isAsked() const { return !camera.empty() || !eye.empty(); }
};

/// Declares --camera, --eye, --target and --size.
void addViewOptions(CLI::App& app, ViewArguments& arguments);

/// The scene's camera of that name, or one at the eye that looks at the target (50 degrees high). Throws
/// base::UsageError, which lists the scene's cameras, or says what is wrong with this one.
scene::Camera chooseView(const ViewArguments& arguments, const scene::Scene& scene);

/// The surface points that a picture's pixels see through their middles.
struct SeenPoints {
    std::vector<scene::Sensor> sensors;
    std::vector<std::size_t> pixels;  ///< of each sensor, row by row from the top
};
SeenPoints lookThrough(const scene::Camera& camera, const ViewArguments& arguments,
                       const rays::RayScene& rays, const scene::Scene& scene);

}  // namespace fluxwalk::cli
