#include "viewer/app/screenshot.h"

#include <algorithm>
#include <functional>

#include <imgui.h>

#include "viewer/app/overlays.h"
#include "viewer/gl/render_target.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/imgui_renderer.h"
#include "viewer/ui/legend.h"

namespace fluxwalk::app {
namespace {

/// Height of a picture whose text has the size of a window's at 96 dpi; smaller ones keep it legible.
constexpr float kPlainHeight = 720.0f;
constexpr float kLeastScale = 0.75f;
constexpr float kLargestScale = 4.0f;

void drawOver(const gl::Functions& gl, gl::PixelSize size,
              const std::function<void(const ui::Canvas&)>& draw) {
    const float scale =
        std::clamp(static_cast<float>(size.height) / kPlainHeight, kLeastScale, kLargestScale);
    const ui::ImguiContext imgui(scale);
    const ui::ImguiRenderer renderer(gl);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
    io.DeltaTime = 1.0f;
    ImGui::NewFrame();
    draw({scale});
    ImGui::Render();
    renderer.draw(*ImGui::GetDrawData());
}

}  // namespace

std::vector<std::uint8_t> drawPicture(gl::Context& context, const std::shared_ptr<const scene::Scene>& scene,
                                      const solve::Snapshot& snapshot, const scene::Camera& camera,
                                      gl::PixelSize size, const render::DrawSettings& look,
                                      const Inspected& inspected, int samples) {
    const gl::Functions& gl = context.functions();
    const gl::RenderTarget target(gl, size, samples);
    render::SceneRenderer renderer(gl, scene);
    renderer.setMeshes(snapshot.meshes, snapshot.lighting);
    std::optional<ui::Legend> legend = fillOverlay(renderer.overlay(), snapshot, look, renderer.colorMap());
    if (look.shown == render::Shown::illuminance || look.shown == render::Shown::luminance) {
        legend = ui::makeLegend(look, renderer.rangeOf(look), renderer.colorMap());
    }
    target.bind();
    renderer.draw(camera, static_cast<double>(size.width) / size.height, look);
    target.resolve();
    if (legend || inspected.inspection != nullptr) {
        drawOver(gl, size, [&](const ui::Canvas& canvas) {
            if (inspected.inspection != nullptr) {
                ui::drawInspection(*inspected.inspection, *scene, camera, inspected.view, canvas);
            }
            const float width = legend ? ui::drawLegend(*legend, canvas) : 0.0f;
            if (inspected.inspection != nullptr && inspected.view.visibility) {
                ui::drawLegend(ui::makeVisibilityLegend(renderer.colorMap()), canvas, width);
            }
        });
    }
    return target.readRgb();
}

std::vector<float> drawLight(gl::Context& context, const std::shared_ptr<const scene::Scene>& scene,
                             const solve::Snapshot& snapshot, const scene::Camera& camera, gl::PixelSize size,
                             int samples) {
    const gl::Functions& gl = context.functions();
    const gl::RenderTarget target(gl, size, samples, gl::PixelFormat::full);
    render::SceneRenderer renderer(gl, scene);
    renderer.setMeshes(snapshot.meshes, snapshot.lighting);
    target.bind();
    renderer.drawLight(camera, static_cast<double>(size.width) / size.height);
    target.resolve();
    return target.readLight();
}

}  // namespace fluxwalk::app
