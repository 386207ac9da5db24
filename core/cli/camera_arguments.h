#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace CLI {
class App;
}

namespace fluxwalk::cli {

/// Where to look from, as typed.
struct CameraArguments {
    std::string name;
    std::vector<double> eye;     ///< metres, empty or 3
    std::vector<double> target;  ///< metres, empty or 3
    double fov = 0.0;            ///< vertical, degrees; 0: the camera's own, or 50 with --eye
};

void addCameraOptions(CLI::App& app, CameraArguments& arguments);

/// The camera asked for, else the scene's first, else what `firstView` finds; a scene's first that nothing
/// can be seen through is passed over. Throws base::UsageError for an unknown name (and lists those there
/// are), half an eye, and an absurd camera.
scene::Camera chooseCamera(const CameraArguments& arguments, const scene::Scene& scene,
                           const std::function<scene::Camera()>& firstView);

}  // namespace fluxwalk::cli
