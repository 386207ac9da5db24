#pragma once

#include "core/base/bounds.h"
#include "core/scene/scene.h"

/// Cameras that move around things.
namespace fluxwalk::ui {

/// Turned about a point, to the right and upwards in radians as the hand would turn the thing; the point
/// keeps its place in the picture. Comes out upright, and never looks straight up or down.
scene::Camera orbit(const scene::Camera& camera, const base::Vec3d& pivot, double turn, double tilt);

/// At `factor` times the distance from a point, but never nearer than `nearest` metres.
scene::Camera dolly(const scene::Camera& camera, const base::Vec3d& pivot, double factor, double nearest);

/// Looks at the middle of a box from the side where the camera is, so near that the box fills the picture.
scene::Camera lookAtWhole(const scene::Camera& camera, const base::Box& box);

}  // namespace fluxwalk::ui
