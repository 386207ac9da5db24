#include <algorithm>
#include <memory>

#include <gtest/gtest.h>
#include <imgui.h>

#include "core/image/final_gather.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/viewer/golden_picture.h"
#include "viewer/app/still_file.h"
#include "viewer/gl/context.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/render/still_pass.h"
#include "viewer/session/still_job.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/imgui_renderer.h"
#include "viewer/ui/still.h"

namespace fluxwalk {
namespace {

// As `render` takes them, from a rough solution.
class StillPictures : public ::testing::TestWithParam<const char*> {};

TEST_P(StillPictures, AreAsBefore) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene(GetParam()));
    solve::Options options;
    options.error = 0.1;
    options.errorOf = solve::ErrorOf::gathered;
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    image::StillOptions still;
    still.width = static_cast<std::uint32_t>(testing::kGoldenSize.width);
    still.height = static_cast<std::uint32_t>(testing::kGoldenSize.height);
    const image::Still picture = image::takeStill(solver.problem(), scene->cameras.front(), still);
    testing::expectGolden(app::developStill(picture, app::meterStill(picture), render::ToneCurve::filmic),
                          std::string("still-") + GetParam() + ".png");
}

/// The window half way through a still: tiles over what they will show, and the bar.
std::vector<std::uint8_t> drawHalfWay(gl::HeadlessKind kind, const std::shared_ptr<const scene::Scene>& scene,
                                      const solve::Solver& solver) {
    const scene::Camera& camera = scene->cameras.front();
    image::StillOptions options;
    options.width = 240;
    options.height = 224;
    session::StillJob job(camera, options);
    job.run([&](const auto& seen, const auto& asked,
                const auto& callbacks) { return image::takeStill(solver.problem(), seen, asked, callbacks); },
            [&] {
                if (job.status().progress >= 0.5) {
                    job.cancel();
                }
            });
    const auto context = gl::makeHeadlessContext(kind);
    const gl::Functions& gl = context->functions();
    const float scale = 0.75f;
    const ui::ImguiContext imgui(scale);
    const ui::ImguiRenderer renderer(gl);
    ImGuiIO& io = ImGui::GetIO();
    const gl::PixelSize window = testing::kGoldenSize;
    io.DisplaySize = ImVec2(static_cast<float>(window.width), static_cast<float>(window.height));
    io.DeltaTime = 1.0f;
    ui::StillInfo info;
    info.isThere = true;
    info.isLarge = true;
    info.progress = job.status().progress;
    info.told = "57 %, 3 s left";
    info.size = {static_cast<int>(options.width), static_cast<int>(options.height)};

    const ui::StillPlace place = ui::placeLarge(info.size);
    const gl::PixelSize size{static_cast<int>(place.width), static_cast<int>(place.height)};
    render::SceneRenderer lit(gl, scene);
    lit.setMeshes(solver.litMeshes());
    const gl::RenderTarget under(gl, size, 4, gl::PixelFormat::full);
    under.bind();
    lit.drawLight(camera, static_cast<double>(options.width) / options.height);
    under.resolve();
    render::StillPass pass(gl, info.size);
    for (const session::StillPart& part : job.takeParts()) {
        pass.put({part.place.left, part.place.top, part.place.width, part.place.height}, part.luminance);
    }
    const gl::RenderTarget shown(gl, size, 1, gl::PixelFormat::byte, false);
    pass.draw(shown, under, {app::meterStill(*job.still()), render::ToneCurve::filmic});

    const gl::RenderTarget target(gl, window, 1);
    // Windows that fit themselves to their content need two frames.
    for (int i = 0; i < 2; ++i) {
        ImGui::NewFrame();
        ui::drawStill(info, ui::textureId(shown.texture().id()), {scale, 0.0f, 0.0f});
        ImGui::Render();
    }
    target.bind();
    renderer.draw(*ImGui::GetDrawData());
    target.resolve();
    return target.readRgb();
}

TEST(StillPreview, FillsInOverWhatItWillShow) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    solve::Options options;
    options.error = 0.1;
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    const std::vector<std::uint8_t> osmesa = drawHalfWay(gl::HeadlessKind::osmesa, scene, solver);
    testing::expectGolden(osmesa, "still-preview.png");
    EXPECT_EQ(drawHalfWay(gl::HeadlessKind::egl, scene, solver), osmesa);
}

INSTANTIATE_TEST_SUITE_P(Golden, StillPictures, ::testing::Values("cornell-box", "gallery"),
                         [](const auto& one) {
                             std::string name = one.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace fluxwalk
