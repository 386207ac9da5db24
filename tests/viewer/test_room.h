#pragma once

#include <memory>

#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"

/// A lit room made by hand, for pictures without a solver.
namespace fluxwalk::testing {

struct TestRoom {
    std::shared_ptr<const scene::Scene> scene;
    scene::LitMeshes meshes;
    scene::Camera camera;
};

/// A box of 2 m open towards +z, red at -x and green at +x, lit by a lamp below the ceiling: irradiance is
/// that of a small horizontal lamp plus a constant. With `textured` the floor has a checkered texture, turned
/// and scaled, and a fence with holes stands in the middle.
TestRoom makeTestRoom(bool textured);

/// One quad from four corners, counter-clockwise seen from the front, cut into cells x cells.
scene::LitMesh makeQuad(const base::Vec3& a, const base::Vec3& b, const base::Vec3& c, const base::Vec3& d,
                        std::uint32_t cells);

}  // namespace fluxwalk::testing
