#include "viewer/ui/orbit.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "core/base/photometry.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

/// Just short of straight up and down, radians.
constexpr double kSteepest = 0.499 * base::kPi;
/// Free space around a box that is looked at as a whole.
constexpr double kAround = 1.15;

Vec3d levelRight(const scene::Camera& camera) {
    const Vec3d right = glm::cross(camera.forward, Vec3d(0.0, 1.0, 0.0));
    return glm::length(right) > 1e-9 ? glm::normalize(right)
                                     : glm::normalize(glm::cross(camera.forward, camera.up));
}

}  // namespace

scene::Camera orbit(const scene::Camera& camera, const Vec3d& pivot, double turn, double tilt) {
    const double pitch = std::asin(std::clamp(camera.forward.y, -1.0, 1.0));
    const double tilted = std::clamp(pitch + tilt, -kSteepest, kSteepest) - pitch;
    const glm::dmat4 about = glm::rotate(glm::dmat4(1.0), -turn, Vec3d(0.0, 1.0, 0.0)) *
                             glm::rotate(glm::dmat4(1.0), tilted, levelRight(camera));
    scene::Camera moved = camera;
    moved.position = pivot + glm::dmat3(about) * (camera.position - pivot);
    moved.forward = glm::normalize(glm::dmat3(about) * camera.forward);
    moved.up = Vec3d(0.0, 1.0, 0.0);
    return moved;
}

scene::Camera dolly(const scene::Camera& camera, const Vec3d& pivot, double factor, double nearest) {
    const Vec3d offset = camera.position - pivot;
    const double distance = glm::length(offset);
    scene::Camera moved = camera;
    if (distance > 0.0) {
        moved.position =
            pivot + offset * (std::max(factor * distance, std::min(nearest, distance)) / distance);
    }
    return moved;
}

scene::Camera lookAtWhole(const scene::Camera& camera, const base::Box& box) {
    const double radius = std::max(0.5 * box.diagonal(), 1e-3);
    const Vec3d offset = camera.position - box.center();
    const double distance = glm::length(offset);
    const Vec3d outwards = distance > 1e-9 ? offset / distance : -camera.forward;
    scene::Camera moved = camera;
    moved.position = box.center() + outwards * (kAround * radius / std::sin(0.5 * camera.verticalFov));
    moved.forward = -outwards;
    const bool isUpright = std::abs(outwards.y) < std::sin(kSteepest);
    moved.up = isUpright ? Vec3d(0.0, 1.0, 0.0) : Vec3d(0.0, 0.0, -1.0);
    return moved;
}

}  // namespace fluxwalk::ui
