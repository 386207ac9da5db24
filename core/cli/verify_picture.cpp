#include "core/cli/verify_picture.h"

#include <cmath>
#include <limits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/cli/values.h"
#include "core/image/sight.h"

namespace fluxwalk::cli {

namespace {

using base::Vec3d;

constexpr unsigned kLargestSide = 4096;
/// Every pixel keeps sums of its own.
constexpr std::uint64_t kMostPixels = 2'000'000;

void parseViewSize(const std::string& text, ViewArguments& arguments) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) {
        throw base::UsageError("--size: '" + text + "' is not WIDTHxHEIGHT, as in 320x240");
    }
    arguments.width = parseCountOption("--size", text.substr(0, cross), 1, kLargestSide);
    arguments.height = parseCountOption("--size", text.substr(cross + 1), 1, kLargestSide);
    if (std::uint64_t{arguments.width} * arguments.height > kMostPixels) {
        throw base::UsageError(
            fmt::format("--size: {} has more than {} pixels, each of which is traced", text, kMostPixels));
    }
}

}  // namespace

void addViewOptions(CLI::App& app, ViewArguments& arguments) {
    addCameraOptions(app, arguments.camera);
    app.add_option_function<std::string>(
           "--size", [&arguments](const std::string& text) { parseViewSize(text, arguments); },
           fmt::format("With a camera, -o names a PNG: a picture of the solution's relative difference from "
                       "the reference at the points that it sees, of so many pixels, each traced for itself. "
                       "Default {}x{}.",
                       arguments.width, arguments.height))
        ->type_name("WxH")
        ->group("Camera");
    app.add_flag("--still", arguments.isOfStill,
                 "With a camera: differences of the light that render gathers at the pixels, with normal and "
                 "height maps, instead of what measure finds there.")
        ->group("Camera");
    app.add_option_function<std::string>(
           "--blur",
           [&arguments](const std::string& text) {
               arguments.blur = parseNumberOption("--blur", text, 0.0, 100.0, "");
           },
           "With a camera: each pixel shows the mean difference around it, by a Gaussian of so many pixels: "
           "the "
           "noise of the reference goes, what is wrong in one direction stays. Default 0: none.")
        ->type_name("PX")
        ->group("Camera");
}

scene::Camera chooseView(const ViewArguments& arguments, const scene::Scene& scene) {
    scene::Camera camera = chooseCamera(arguments.camera, scene, [] { return scene::Camera{}; });
    camera.forward = glm::normalize(camera.forward);
    return camera;
}

SeenPoints lookAsStill(const scene::Camera& camera, const ViewArguments& arguments,
                       const solve::Problem& problem) {
    const image::Lens lens(camera, arguments.width, arguments.height);
    SeenPoints seen;
    for (std::uint32_t y = 0; y < arguments.height; ++y) {
        for (std::uint32_t x = 0; x < arguments.width; ++x) {
            const auto found = image::lookAlong(problem, lens.eye(), lens.directionAt({x + 0.5, y + 0.5}));
            if (found && found->leaf != base::NodeId::none) {
                seen.sensors.push_back({found->point.position, found->point.shading});
                seen.pixels.push_back(std::size_t{y} * arguments.width + x);
            }
        }
    }
    if (seen.sensors.empty()) {
        throw base::UsageError("the camera sees nothing that light reaches");
    }
    return seen;
}

SeenPoints lookThrough(const scene::Camera& camera, const ViewArguments& arguments,
                       const rays::RayScene& rays, const scene::Scene& scene) {
    const Vec3d right = glm::normalize(glm::cross(camera.forward, camera.up));
    const Vec3d up = glm::cross(right, camera.forward);
    const double pixel = 2.0 * std::tan(0.5 * camera.verticalFov) / arguments.height;
    SeenPoints seen;
    for (std::uint32_t y = 0; y < arguments.height; ++y) {
        for (std::uint32_t x = 0; x < arguments.width; ++x) {
            const Vec3d direction = camera.forward + pixel * (x + 0.5 - 0.5 * arguments.width) * right -
                                    pixel * (y + 0.5 - 0.5 * arguments.height) * up;
            const rays::Ray ray{base::Vec3(camera.position), 0.0f, base::Vec3(direction),
                                std::numeric_limits<float>::max()};
            const auto hit = rays.closest(ray);
            if (!hit) {
                continue;
            }
            const surface::Surface& surface = *scene.objects[base::index(hit->object)].surface;
            const Vec3d met = Vec3d(ray.origin) + static_cast<double>(hit->t) * Vec3d(ray.direction);
            const surface::SurfacePoint p = surface.evaluate(hit->patch, surface.locate(hit->patch, met));
            seen.sensors.push_back({p.position, hit->back ? -p.normal : p.normal});
            seen.pixels.push_back(std::size_t{y} * arguments.width + x);
        }
    }
    if (seen.sensors.empty()) {
        throw base::UsageError("the camera sees nothing of the scene");
    }
    return seen;
}

}  // namespace fluxwalk::cli
