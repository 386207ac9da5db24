#include <array>
#include <map>
#include <memory>

#include <gtest/gtest.h>
#include <imgui.h>

#include "core/scene/builders.h"
#include "core/solve/options_table.h"
#include "core/solve/solver.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/panel.h"

// Every widget of the section Solution is turned with the mouse, and what it was turned to is solved.

namespace fluxwalk::ui {
namespace {

constexpr float kWidth = 348.0f;
constexpr float kHeight = 700.0f;

/// The section alone, in a window of its own, with a mouse.
class SolutionSection : public ::testing::Test {
  protected:
    SolutionSection() : imgui_(1.0f) {
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = ImVec2(kWidth, kHeight);
        io.DeltaTime = 1.0f / 60.0f;
        // Nothing is drawn, but letters have widths.
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }

    bool frame() {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
        ImGui::SetNextWindowSize(ImVec2(kWidth, kHeight));
        ImGui::Begin("section", nullptr, ImGuiWindowFlags_NoDecoration);
        const bool isChanged = drawSolution({}, options_);
        hasPopup_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
        ImGui::End();
        ImGui::Render();
        return isChanged;
    }
    bool click(float x, float y) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = ImVec2(x, y);
        bool isChanged = frame();
        for (const bool isDown : {true, true, false, false}) {
            io.MouseDown[0] = isDown;
            isChanged |= frame();
        }
        return isChanged;
    }
    /// Opens the part that is folded at first.
    void unfold() {
        for (float y = 10.0f; y < 160.0f; y += 8.0f) {
            click(28.0f, y);
        }
        options_ = {};
    }

    /// Names of the options that are not as `before`.
    std::vector<std::string> changedFrom(const solve::Options& before) const {
        std::vector<std::string> names;
        for (const solve::OptionInfo& option : solve::optionsTable()) {
            if (option.get(options_) != option.get(before)) {
                names.emplace_back(option.name);
            }
        }
        return names;
    }

    /// Options as each widget leaves them that stands beside a label, every other one as by default.
    std::map<std::string, solve::Options> turnAll() {
        std::map<std::string, solve::Options> turned;
        for (float y = 10.0f; y < kHeight - 10.0f; y += 8.0f) {
            // Left end of sliders and the box of flags, then the middle.
            for (const float x : {0.47f * kWidth, 0.7f * kWidth}) {
                options_ = {};
                const bool isChanged = click(x, y);
                keep(isChanged, turned);
                // A list: each of its lines.
                for (float below = y + 16.0f; hasPopup_ && below < y + 140.0f; below += 12.0f) {
                    keep(click(x, below), turned);
                    if (!hasPopup_) {
                        options_ = {};
                        click(x, y);
                    }
                }
                if (hasPopup_) {
                    click(2.0f, 2.0f);
                }
            }
        }
        return turned;
    }

    void keep(bool isChanged, std::map<std::string, solve::Options>& turned) const {
        const std::vector<std::string> names = changedFrom({});
        EXPECT_EQ(isChanged, !names.empty());
        EXPECT_LE(names.size(), 1u);
        if (names.size() == 1) {
            turned.try_emplace(names.front(), options_);
        }
    }

    ImguiContext imgui_;
    solve::Options options_;
    bool hasPopup_ = false;
};

TEST_F(SolutionSection, EveryWidgetTurnsItsOptionAndNoOther) {
    unfold();
    std::vector<std::string> names;
    for (const auto& [name, options] : turnAll()) {
        names.push_back(name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"cluster-links", "cluster-model", "clusters",
                                               "curvature-weight", "error", "min-area", "oracle", "pull",
                                               "rays", "row-scaling", "threshold", "visibility-rays"}));
}

/// What a solution of these options is made of.
std::array<double, 4> solved(const std::shared_ptr<const scene::Scene>& scene,
                             const solve::Options& options) {
    solve::Solver solver(scene, options, 0);
    solver.solve({});
    const solve::Statistics s = solver.show({})->statistics;
    return {static_cast<double>(s.counters.links), static_cast<double>(s.counters.leaves),
            static_cast<double>(s.counters.rays), s.meanIrradiance};
}

TEST_F(SolutionSection, WhatIsTurnedIsSolvedOtherwise) {
    unfold();
    const auto turned = turnAll();
    // Curved and closed: options of curvature, of pulling and of rows show.
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("furnace"));
    solve::Options plain;
    plain.error = 0.2;
    plain.linkLimit = 20000;
    // Options of clusters show where there are clusters.
    solve::Options clustered = plain;
    solve::findOption("cluster-links")->set(clustered, 1.0);
    const auto base = solved(scene, plain);
    const auto clusteredBase = solved(scene, clustered);
    for (const auto& [name, options] : turned) {
        SCOPED_TRACE(name);
        const bool isOfClusters = name == "clusters" || name == "cluster-model";
        solve::Options wanted = isOfClusters ? clustered : plain;
        const solve::OptionInfo& option = *solve::findOption(name);
        option.set(wanted, option.get(options));
        const auto result = solved(scene, wanted);
        if (name == "rays") {
            // Two ways to the same answers.
            EXPECT_NEAR(result[3], base[3], 1e-3 * base[3]);
        } else {
            EXPECT_NE(result, isOfClusters ? clusteredBase : base);
        }
    }
}

}  // namespace
}  // namespace fluxwalk::ui
