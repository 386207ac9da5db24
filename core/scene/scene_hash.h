#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace fluxwalk::scene {

/// Digest of what light in a scene depends on: shapes, their texture coordinates, reflectance, emission,
/// holes, lights and the sky; names, cameras and normal maps do not count. Triangles enter with every corner,
/// other shapes by points all over each patch: two that agree there are taken for one.
std::uint64_t hashScene(const Scene& scene);

}  // namespace fluxwalk::scene
