#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image/inspect.h"
#include "core/scene/scene.h"
#include "core/solve/solver.h"
#include "viewer/gl/context.h"
#include "viewer/gl/pixel_size.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/ui/inspection.h"

namespace fluxwalk::app {

/// A point whose values are drawn into a picture; null for none.
struct Inspected {
    const image::Inspection* inspection = nullptr;
    ui::InspectionView view{};
};

/// Draws a solution with smooth edges (`samples` a pixel, or as many as the context has), and a legend where
/// values are shown: 3 bytes a pixel, sRGB, rows from the top.
std::vector<std::uint8_t> drawPicture(gl::Context& context, const std::shared_ptr<const scene::Scene>& scene,
                                      const solve::Snapshot& snapshot, const scene::Camera& camera,
                                      gl::PixelSize size, const render::DrawSettings& look,
                                      const Inspected& inspected = {}, int samples = 8);

/// The light itself, without exposure, curve, glow and overlays: linear luminance in cd/m2, 3 floats a pixel,
/// rows from the top.
std::vector<float> drawLight(gl::Context& context, const std::shared_ptr<const scene::Scene>& scene,
                             const solve::Snapshot& snapshot, const scene::Camera& camera, gl::PixelSize size,
                             int samples = 8);

}  // namespace fluxwalk::app
