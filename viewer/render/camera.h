#pragma once

#include "core/base/bounds.h"
#include "core/scene/look_at.h"

namespace fluxwalk::render {

using scene::lookAt;

/// Distances along the view in metres between which the scene is drawn.
struct ClipRange {
    double nearest = 0.0;
    double farthest = 0.0;
};
/// From close before the eye (a part of the scene's size) to behind the farthest corner of its box.
ClipRange clipRangeFor(const scene::Camera& camera, const base::Box& bounds);

/// Unit direction in which a place of a picture is seen: x and y from -1 (left, bottom) to 1.
base::Vec3d directionAt(const scene::Camera& camera, double aspect, const base::Vec2d& place);

/// World to GL clip space, for a picture `aspect` times as wide as high.
glm::mat4 clipFromWorld(const scene::Camera& camera, double aspect, const ClipRange& range);

}  // namespace fluxwalk::render
