#include "core/cli/verify_picture.h"

#include <cmath>
#include <limits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/cli/suggest.h"
#include "core/cli/values.h"
#include "core/scene/camera_path.h"

namespace fluxwalk::cli {

namespace {

using base::Vec3d;

constexpr double kFov = 50.0;  // degrees
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

Vec3d toVector(const std::vector<double>& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

void addViewOptions(CLI::App& app, ViewArguments& arguments) {
    CLI::Option* name =
        app.add_option("--camera", arguments.camera,
                       "A picture of the solution's relative difference from the reference at the "
                       "points that a camera of the scene sees; -o then names a PNG.");
    name->type_name("NAME")->group("Picture of differences");
    const auto addPoint = [&](const char* option, std::vector<double>& point, const char* description) {
        return app.add_option(option, point, description)
            ->delimiter(',')
            ->expected(3)
            ->type_name("X,Y,Z")
            ->excludes(name)
            ->group("Picture of differences");
    };
    CLI::Option* eye = addPoint("--eye", arguments.eye, "The same from a place, in metres.");
    CLI::Option* target = addPoint("--target", arguments.target, "Where to look from there, in metres.");
    eye->needs(target);
    target->needs(eye);
    app.add_option_function<std::string>(
           "--size", [&arguments](const std::string& text) { parseViewSize(text, arguments); },
           fmt::format("Pixels, each traced for itself. Default {}x{}.", arguments.width, arguments.height))
        ->type_name("WxH")
        ->group("Picture of differences");
}

scene::Camera chooseView(const ViewArguments& arguments, const scene::Scene& scene) {
    scene::Camera camera;
    if (arguments.camera.empty()) {
        camera.position = toVector(arguments.eye);
        camera.forward = toVector(arguments.target) - camera.position;
        // Looking straight up or down, north (-z) is up in the picture.
        const bool isVertical = camera.forward.x == 0.0 && camera.forward.z == 0.0;
        camera.up = isVertical ? Vec3d(0.0, 0.0, -1.0) : Vec3d(0.0, 1.0, 0.0);
        camera.verticalFov = kFov * base::kPi / 180.0;
        if (!(glm::length(camera.forward) > 0.0)) {
            throw base::UsageError("--eye and --target must be two different points");
        }
    } else {
        std::vector<std::string> names;
        const scene::Camera* found = nullptr;
        for (const scene::Camera& candidate : scene.cameras) {
            names.push_back(candidate.name);
            found = candidate.name == arguments.camera && found == nullptr ? &candidate : found;
        }
        if (found == nullptr) {
            std::string list;
            for (const std::string& name : names) {
                list += (list.empty() ? "; it has " : ", ") + name;
            }
            throw base::UsageError(
                base::toOneLine("--camera: the scene has no camera '" + arguments.camera + "'" + list));
        }
        camera = *found;
    }
    camera.forward = glm::normalize(camera.forward);
    if (const auto fault = scene::findFault(camera)) {
        throw base::UsageError("the camera " + *fault);
    }
    return camera;
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
