#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"
#include "viewer/gl/context.h"
#include "viewer/gl/pixel_size.h"
#include "viewer/render/scene_renderer.h"

namespace fluxwalk::app {

/// Draws lit meshes with smooth edges, and a legend where values are shown: 3 bytes a pixel, sRGB, rows from
/// the top.
std::vector<std::uint8_t> drawPicture(gl::Context& context, const std::shared_ptr<const scene::Scene>& scene,
                                      const scene::LitMeshes& meshes, const scene::Camera& camera,
                                      gl::PixelSize size, const render::DrawSettings& look);

}  // namespace fluxwalk::app
