#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>

#include "core/image/still_options.h"
#include "viewer/ui/imgui_context.h"
#include "viewer/ui/still.h"

namespace fluxwalk::ui {
namespace {

constexpr float kWidth = 1000.0f;
constexpr float kHeight = 700.0f;

/// What is drawn for stills, with a mouse and without a picture.
class Stills : public ::testing::Test {
  protected:
    Stills() : imgui_(1.0f) {
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = ImVec2(kWidth, kHeight);
        io.DeltaTime = 1.0f / 60.0f;
        // Nothing is drawn, but letters have widths.
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        info_.size = {1280, 720};
    }

    StillActions section() {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
        ImGui::SetNextWindowSize(ImVec2(348.0f, kHeight));
        ImGui::Begin("section", nullptr, ImGuiWindowFlags_NoDecoration);
        const StillActions actions = drawStillSettings(info_, settings_, 0.04);
        ImGui::End();
        ImGui::Render();
        return actions;
    }
    StillActions frame() {
        ImGui::NewFrame();
        const StillActions actions = drawStill(info_, nullptr, {1.0f, 58.0f, 362.0f});
        ImGui::Render();
        return actions;
    }
    static StillActions click(float x, float y, const std::function<StillActions()>& draw) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = ImVec2(x, y);
        StillActions all = draw();
        for (const bool isDown : {true, true, false, false}) {
            io.MouseDown[0] = isDown;
            all.add(draw());
        }
        return all;
    }
    static std::set<std::string> namesOf(const StillActions& actions) {
        std::set<std::string> names;
        const auto note = [&names](bool isMeant, const char* name) {
            if (isMeant) {
                names.insert(name);
            }
        };
        note(actions.takes, "takes");
        note(actions.cancels, "cancels");
        note(actions.closes, "closes");
        note(actions.resizes, "resizes");
        note(actions.keepsPicture, "keeps picture");
        note(actions.keepsLight, "keeps light");
        return names;
    }
    /// All that clicks anywhere in a part of the window do.
    std::set<std::string> sweep(float left, float top, float right, float bottom) {
        const auto draw = [this] { return frame(); };
        draw();
        draw();
        std::set<std::string> names;
        for (float y = top; y < bottom; y += 8.0f) {
            for (float x = left; x < right; x += 12.0f) {
                for (const std::string& name : namesOf(click(x, y, draw))) {
                    names.insert(name);
                }
            }
        }
        return names;
    }

    ImguiContext imgui_;
    StillInfo info_;
    StillSettings settings_;
};

TEST_F(Stills, EveryWidgetTurnsItsOption) {
    const auto draw = [this] { return section(); };
    std::set<std::string> turned;
    bool isTaken = false;
    for (float y = 8.0f; y < 240.0f; y += 8.0f) {
        settings_ = {};
        isTaken = click(175.0f, y, draw).takes || isTaken;
        for (const image::StillOptionInfo& option : image::stillOptionsTable()) {
            const unsigned value = option.get(settings_.options);
            EXPECT_GE(value, option.minimum);
            EXPECT_LE(value, option.maximum);
            if (value != option.defaultValue()) {
                turned.emplace(option.name);
            }
        }
        if (settings_.hasOwnExposure) {
            turned.emplace("exposure");
        }
        // The list of sizes is opened by that click; a line of it is chosen.
        for (float below = y + 40.0f; below < y + 70.0f; below += 10.0f) {
            click(175.0f, below, draw);
        }
        if (settings_.size.width > 0) {
            turned.emplace("size");
        }
    }
    EXPECT_EQ(turned, (std::set<std::string>{"exposure", "samples", "shadow-rays", "size"}));
    EXPECT_TRUE(isTaken);
}

TEST_F(Stills, TheButtonCancelsWhatIsBeingMade) {
    info_.isThere = true;
    std::set<std::string> names;
    for (float y = 8.0f; y < 240.0f; y += 8.0f) {
        for (const std::string& name : namesOf(click(250.0f, y, [this] { return section(); }))) {
            names.insert(name);
        }
    }
    EXPECT_EQ(names, std::set<std::string>{"cancels"});
}

TEST_F(Stills, TheBarOffersWhatCanBeDone) {
    for (const bool isLarge : {true, false}) {
        SCOPED_TRACE(isLarge);
        info_ = {};
        info_.size = {1280, 720};
        info_.isThere = true;
        info_.isLarge = isLarge;
        const auto all = [&] {
            return isLarge ? sweep(362.0f, 540.0f, kWidth, kHeight) : sweep(620.0f, 0.0f, kWidth, 330.0f);
        };
        EXPECT_EQ(all(), (std::set<std::string>{"cancels", "resizes"}));
        info_.isOver = true;
        EXPECT_EQ(all(), (std::set<std::string>{"closes", "resizes"})) << "while it is being written";
        info_.canBeKept = true;
        EXPECT_EQ(all(), (std::set<std::string>{"closes", "keeps light", "keeps picture", "resizes"}));
    }
}

TEST_F(Stills, PlacesKeepTheProportions) {
    frame();
    for (const gl::PixelSize size : {gl::PixelSize{1280, 720}, {720, 1280}, {2048, 2048}, {16384, 1}}) {
        for (const StillPlace& place : {placeLarge(size), placeSmall(size, 1.0f)}) {
            EXPECT_GE(place.left, 0.0f);
            EXPECT_GE(place.top, 0.0f);
            EXPECT_GE(place.height, 1.0f);
            EXPECT_LE(place.left + place.width, kWidth);
            EXPECT_LE(place.top + place.height, kHeight);
            if (size.height > 1) {
                EXPECT_NEAR(place.width / place.height,
                            static_cast<float>(size.width) / static_cast<float>(size.height), 0.02f);
            }
        }
    }
}

}  // namespace
}  // namespace fluxwalk::ui
