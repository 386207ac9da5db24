#pragma once

#include "core/rays/ray.h"
#include "core/scene/scene.h"
#include "viewer/gl/pixel_size.h"

namespace fluxwalk::app {

/// What is seen at a place of a picture, in pixels from its upper left corner.
rays::Ray rayThrough(const scene::Camera& camera, gl::PixelSize size, const base::Vec2d& pixel);

}  // namespace fluxwalk::app
