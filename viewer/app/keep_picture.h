#pragma once

#include <filesystem>
#include <string_view>

#include "core/scene/scene.h"
#include "viewer/gl/functions.h"
#include "viewer/gl/pixel_size.h"
#include "viewer/render/scene_renderer.h"

namespace fluxwalk::app {

/// What a picture shows, and how large it is in pixels.
struct KeptView {
    scene::Camera camera;
    gl::PixelSize size;
    render::DrawSettings look;
};

/// Writes what is seen, without the panel, into the folder where the program was started: PNG, or the light
/// itself as EXR. Returns the new file, named after `name`. Throws base::FileError.
std::filesystem::path keepPicture(const gl::Functions& gl, render::SceneRenderer& renderer,
                                  const KeptView& view, std::string_view name, bool asLight);

}  // namespace fluxwalk::app
