#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

/// Cameras that move.
namespace fluxwalk::scene {

/// Why nothing can be seen through a camera, in words; nothing for a sound one. Sound are finite places
/// within 1e6 m of the origin, a direction and an up that differ, and fields of view from .1 to 179.9
/// degrees.
std::optional<std::string> findFault(const Camera& camera);

struct CameraKey {
    double seconds = 0.0;
    Camera camera;
};

/// Key frames in the order of their times, which differ.
using CameraPath = std::vector<CameraKey>;

/// Seconds from the first key to the last.
double durationOf(const CameraPath& path);

/// The camera so many seconds after the first key, held before the first and after the last. Place, direction
/// and field of view have continuous speeds, and no coordinate of the place leaves the range of the two keys
/// around it: a path between walls does not swing through them. The path has at least one key.
Camera cameraAt(const CameraPath& path, double seconds);

}  // namespace fluxwalk::scene
