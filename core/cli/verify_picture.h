#pragma once

#include <cstdint>
#include <vector>

#include "core/cli/camera_arguments.h"
#include "core/rays/ray_scene.h"
#include "core/scene/scene.h"
#include "core/scene/sensor.h"
#include "core/solve/state.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// From where a picture of differences is taken, as typed.
struct ViewArguments {
    CameraArguments camera;
    std::uint32_t width = 320;
    std::uint32_t height = 240;
    /// Of what `render` gathers at the pixels, instead of what `measure` does.
    bool isOfStill = false;
    double blur = 0.0;  ///< standard deviation in pixels

    bool isAsked() const { return !camera.name.empty() || !camera.eye.empty(); }
};

/// Declares --camera, --eye, --target, --fov, --size, --still and --blur.
void addViewOptions(CLI::App& app, ViewArguments& arguments);

/// The camera that is asked for (chooseCamera), its direction of unit length.
scene::Camera chooseView(const ViewArguments& arguments, const scene::Scene& scene);

/// The surface points that a picture's pixels see through their middles.
struct SeenPoints {
    std::vector<scene::Sensor> sensors;
    std::vector<std::size_t> pixels;  ///< of each sensor, row by row from the top
};
SeenPoints lookThrough(const scene::Camera& camera, const ViewArguments& arguments,
                       const rays::RayScene& rays, const scene::Scene& scene);
/// The points of a still, with the normals that it shades, where light reaches.
SeenPoints lookAsStill(const scene::Camera& camera, const ViewArguments& arguments,
                       const solve::Problem& problem);

}  // namespace fluxwalk::cli
