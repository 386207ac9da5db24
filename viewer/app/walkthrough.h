#pragma once

#include <memory>

#include "viewer/app/exhibit.h"
#include "viewer/app/scene_opener.h"
#include "viewer/gl/window_context.h"

namespace fluxwalk::app {

/// Runs the window until it is closed, through the first exhibit and those that the user opens. Where a scene
/// is solved, the solver starts at once and is stopped when the scene is left; the window does not wait for
/// that.
void walkThrough(gl::WindowContext& window, std::unique_ptr<Exhibit> exhibit, const OpenScene& open);

}  // namespace fluxwalk::app
