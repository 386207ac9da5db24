#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/vec.h"

/// The displayed result as plain arrays: what the viewer draws and `solve -o` writes.
namespace fluxwalk::scene {

/// One side of one object, triangulated without cracks. All vertex arrays have the same length (texcoords may
/// be empty).
struct LitMesh {
    std::uint32_t object = 0;    ///< index into Scene::objects
    std::uint32_t material = 0;  ///< index into Scene::materials
    bool back =
        false;  ///< the side against the surface's normal; windings and normals already face the viewer
    std::vector<base::Vec3> positions;
    std::vector<base::Vec3> normals;
    std::array<std::vector<base::Vec2>, 2> texcoords;
    std::vector<base::Rgb> irradiance;     ///< lux, each channel
    std::vector<std::uint32_t> triangles;  ///< three indices each, counter-clockwise seen from this side
};

/// Meshes are shared: a snapshot keeps those that did not change.
using LitMeshes = std::vector<std::shared_ptr<const LitMesh>>;

}  // namespace fluxwalk::scene
