#include "viewer/ui/panel.h"

#include <cmath>

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/viewer/test_room.h"
#include "viewer/gl/context.h"
#include "viewer/gl/render_target.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/imgui_renderer.h"

namespace fluxwalk::ui {
namespace {

/// A solution as it is after some seconds.
solve::Snapshot makeSnapshot() {
    solve::Snapshot snapshot;
    solve::Statistics& s = snapshot.statistics;
    s.counters.links = 234567;
    s.counters.leaves = 45678;
    s.counters.nodes = 61234;
    s.counters.rays = 12345678;
    s.counters.bytesLinks = 3753072;
    s.counters.bytesNodes = 12246800;
    s.audit.emitted = base::Vec3d(7.0);
    s.audit.absorbed = base::Vec3d(5.5);
    s.audit.escaped = base::Vec3d(1.49);
    s.threshold = 0.0123;
    s.residual = 3e-4;
    s.estimatedError = 0.031;
    s.meanIrradiance = 12.5;
    s.times.total = 4.2;
    s.times.refine = 0.6;
    for (int i = 0; i < 12; ++i) {
        solve::HistoryEntry entry;
        entry.seconds = 0.1 * std::exp2(0.5 * i);
        entry.error = 0.4 * std::exp2(-0.35 * i);
        entry.residual = 0.3 * std::exp2(-i);
        s.history.push_back(entry);
    }
    return snapshot;
}

/// The panel on a headless picture, with a mouse.
class Panel : public ::testing::TestWithParam<gl::HeadlessKind> {
  protected:
    Panel()
        : context_(gl::makeHeadlessContext(GetParam())),
          imgui_(1.0f),
          renderer_(context_->functions()),
          target_(context_->functions(), {900, 1200}, 1),
          room_(testing::makeTestRoom(false)),
          snapshot_(makeSnapshot()),
          walker_(room_.camera, base::Box{}) {
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = ImVec2(900.0f, 1200.0f);
        io.DeltaTime = 1.0f / 60.0f;
        info_.scene = room_.scene.get();
        info_.snapshot = &snapshot_;
        info_.session = session::Status{};
        info_.session->progress = 0.5;
        info_.renderer = context_->renderer();
        settings_.exposure.exposure = 0.01;
    }
    PanelActions frame() {
        ImGui::NewFrame();
        const PanelActions actions = drawPanel(info_, settings_, options_, walker_, 1.0f);
        ImGui::Render();
        return actions;
    }
    /// Presses and releases the left button at a place; returns what came of it.
    PanelActions click(ImVec2 place) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = place;
        PanelActions all = frame();
        for (const bool isDown : {true, true, false, false}) {
            io.MouseDown[0] = isDown;
            const PanelActions actions = frame();
            all.changedOptions |= actions.changedOptions;
            all.togglesPause |= actions.togglesPause;
            all.steps |= actions.steps;
        }
        return all;
    }

    std::unique_ptr<gl::Context> context_;
    ImguiContext imgui_;
    ImguiRenderer renderer_;
    gl::RenderTarget target_;
    testing::TestRoom room_;
    solve::Snapshot snapshot_;
    Walker walker_;
    PanelInfo info_;
    ViewSettings settings_;
    solve::Options options_;
};

TEST_P(Panel, IsDrawn) {
    frame();
    frame();
    target_.bind();
    context_->functions().ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    context_->functions().Clear(GL_COLOR_BUFFER_BIT);
    target_.resolve();
    renderer_.draw(*ImGui::GetDrawData());
    const std::vector<std::uint8_t> pixels = target_.readRgb();
    EXPECT_EQ(context_->functions().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    // Text and widgets on the left, nothing on the right.
    std::size_t bright = 0;
    for (std::size_t y = 0; y < 1200; ++y) {
        for (std::size_t x = 0; x < 900; ++x) {
            const bool isLit = pixels[3 * (y * 900 + x) + 1] > 140;
            bright += isLit ? 1 : 0;
            ASSERT_FALSE(isLit && x > 400) << x << ' ' << y;
        }
    }
    EXPECT_GT(bright, 3000u);
}

TEST_P(Panel, PauseIsClicked) {
    frame();
    const PanelActions actions = click(ImVec2(14 + 348 - 14 - 40, 14 + 24 + 12 + 15 + 6 + 12));
    EXPECT_TRUE(actions.togglesPause);
    EXPECT_FALSE(actions.changedOptions);
}

TEST_P(Panel, StepIsClickedWhilePaused) {
    // Left of the button that continues.
    const ImVec2 place(14 + 348 - 14 - 84 - 8 - 27, 14 + 24 + 12 + 15 + 6 + 12);
    frame();
    EXPECT_FALSE(click(place).steps);
    info_.isPaused = true;
    const PanelActions actions = click(place);
    EXPECT_TRUE(actions.steps);
    EXPECT_FALSE(actions.togglesPause);
}

TEST_P(Panel, OverlaysAreOfferedWhereSomethingIsSolved) {
    // Clicking all down the column of widgets leaves no overlay on in a lit file, and some where a scene is
    // solved.
    for (const bool isSolved : {false, true}) {
        if (!isSolved) {
            info_.session.reset();
        } else {
            info_.session = session::Status{};
        }
        settings_ = {};
        bool isAny = false;
        for (float y = 60.0f; y < 800.0f; y += 6.0f) {
            click(ImVec2(14 + 14 + 348 * 0.40f + 4, y));
            isAny =
                isAny || settings_.draw.elementEdges || settings_.draw.clusterBoxes || settings_.isProbing;
        }
        EXPECT_EQ(isAny, isSolved);
    }
}

TEST_P(Panel, ErrorTargetIsSlid) {
    frame();
    // Below the heading of the section: the slider's left end asks for little error.
    bool changed = false;
    for (float y = 90.0f; y < 180.0f && !changed; y += 6.0f) {
        changed = click(ImVec2(14 + 348 * 0.40f + 40, y)).changedOptions;
    }
    EXPECT_TRUE(changed);
    EXPECT_GT(options_.error, 0.0009);
    EXPECT_LT(options_.error, 0.02);
}

TEST_P(Panel, StatesAreShownWithoutASolution) {
    info_.snapshot = nullptr;
    for (const session::Phase phase :
         {session::Phase::solving, session::Phase::paused, session::Phase::finished, session::Phase::stopped,
          session::Phase::failed}) {
        info_.session->phase = phase;
        info_.session->failure = std::make_exception_ptr(std::runtime_error("out of links"));
        frame();
    }
    info_.session.reset();
    EXPECT_FALSE(frame().changedOptions);
}

INSTANTIATE_TEST_SUITE_P(Contexts, Panel, ::testing::Values(gl::HeadlessKind::egl, gl::HeadlessKind::osmesa));

}  // namespace
}  // namespace fluxwalk::ui
