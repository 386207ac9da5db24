#pragma once

#include "core/rays/ray_scene.h"
#include "core/scene/lit_mesh.h"

namespace fluxwalk::app {

/// A good first view of a scene without cameras. In a closed room: from near a wall at eye height along the
/// longest free line. Else from outside, through the opening if the scene is a box with an open side, or from
/// above a corner. `bounds` is that of the scene behind `rays`.
scene::Camera chooseFirstView(const rays::RayScene& rays, const base::Box& bounds);

/// The lit meshes as a scene of their own, so that rays can meet what a lit file shows.
scene::Scene sceneOfMeshes(const scene::LitMeshes& meshes);

}  // namespace fluxwalk::app
