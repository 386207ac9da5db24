#include "viewer/ui/imgui_context.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "viewer/gl/context.h"
#include "viewer/gl/render_target.h"
#include "viewer/ui/imgui_renderer.h"
#include "viewer/ui/keys.h"
#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

/// Bright pixels of the help as it is drawn on a picture.
int countBright(const gl::Context& context, const ImguiContext& imgui, const ImguiRenderer& renderer) {
    const gl::RenderTarget target(context.functions(), {1600, 1400}, 1);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(1600.0f, 1400.0f);
    io.DeltaTime = 1.0f;
    // Windows that fit themselves to their content need two frames.
    for (int i = 0; i < 3; ++i) {
        ImGui::NewFrame();
        drawKeyTable(imgui.scale());
        ImGui::Render();
    }
    target.bind();
    renderer.draw(*ImGui::GetDrawData());
    target.resolve();
    int bright = 0;
    for (const std::uint8_t value : target.readRgb()) {
        bright += value > 120 ? 1 : 0;
    }
    return bright;
}

TEST(ImguiContext, FollowsADisplayOfTwiceThePixels) {
    const auto context = gl::makeHeadlessContext(gl::HeadlessKind::automatic);
    ImguiContext imgui(1.0f);
    ImguiRenderer renderer(context->functions());
    const int before = countBright(*context, imgui, renderer);
    EXPECT_GT(before, 3000);
    EXPECT_EQ(ImGui::GetFontSize(), kFontSize);
    const float padding = ImGui::GetStyle().WindowPadding.x;
    imgui.rescale(2.0f);
    renderer.takeGlyphs();
    EXPECT_EQ(imgui.scale(), 2.0f);
    EXPECT_EQ(ImGui::GetStyle().WindowPadding.x, 2.0f * padding);
    // Letters of twice the size, not blurred or missing ones.
    const double growth = static_cast<double>(countBright(*context, imgui, renderer)) / before;
    EXPECT_GT(growth, 3.0);
    EXPECT_LT(growth, 5.5);
    EXPECT_EQ(ImGui::GetFontSize(), 2.0f * kFontSize);
}

}  // namespace
}  // namespace fluxwalk::ui
