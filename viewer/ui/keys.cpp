#include "viewer/ui/keys.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <imgui.h>

#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

constexpr std::array kMoving{KeyLine{"W A S D, arrows", "walk, fly"},
                             KeyLine{"Q, E", "down, up; on foot: stoop, stretch"},
                             KeyLine{"Shift, Ctrl", "run, creep"},
                             KeyLine{"F", "walk or fly"},
                             KeyLine{"right drag, Tab", "look around, capture the mouse"},
                             KeyLine{"wheel", "speed"},
                             KeyLine{"+, -", "narrower, wider view"}};
constexpr std::array kAround{KeyLine{"Alt drag, middle drag", "orbit about the point under the cursor"},
                             KeyLine{"wheel while orbiting", "nearer, farther"},
                             KeyLine{"G", "go to the object under the cursor"}};
constexpr std::array kPlaces{
    KeyLine{"B", "keep this view as a bookmark"}, KeyLine{"1 to 9", "go to a bookmark"},
    KeyLine{"R", "begin or end the recording of a path"}, KeyLine{"L", "play the last path, or stop it"}};
constexpr std::array kSeeing{KeyLine{"C", "illuminance in false colour, or the picture"},
                             KeyLine{"I", "values of the point under the cursor; a click pins it"},
                             KeyLine{"P", "pause or continue the solver"},
                             KeyLine{"N", "one level further while paused"}};
constexpr std::array kWindow{KeyLine{"F1", "this help"},
                             KeyLine{"F11", "full screen"},
                             KeyLine{"F12, Shift F12", "keep the picture as PNG, the light as EXR"},
                             KeyLine{"H", "panel"},
                             KeyLine{"Esc", "release mouse and pin, close help and messages"},
                             KeyLine{"drop a file", "open that scene"}};
constexpr std::array kGroups{KeyGroup{"Moving", kMoving}, KeyGroup{"Around things", kAround},
                             KeyGroup{"Places and paths", kPlaces}, KeyGroup{"Seeing", kSeeing},
                             KeyGroup{"Window", kWindow}};
/// Groups from here on stand in the right half of the window's help.
constexpr std::size_t kRightHalf = 2;

void drawGroup(const KeyGroup& group, float width) {
    ImGui::TextColored(kAccent, "%s", group.title.data());
    for (const KeyLine& line : group.lines) {
        const float left = ImGui::GetCursorPosX();
        ImGui::TextUnformatted(line.keys.data());
        ImGui::SameLine();
        ImGui::SetCursorPosX(left + width);
        ImGui::TextColored(kTextDim, "%s", line.meaning.data());
    }
    ImGui::Spacing();
    ImGui::Spacing();
}

}  // namespace

std::span<const KeyGroup> keyGroups() {
    return kGroups;
}

std::string describeKeys() {
    std::size_t width = 0;
    for (const KeyGroup& group : kGroups) {
        for (const KeyLine& line : group.lines) {
            width = std::max(width, line.keys.size());
        }
    }
    std::string text = "Keys in the window:\n";
    for (const KeyGroup& group : kGroups) {
        for (const KeyLine& line : group.lines) {
            text += "  " + std::string(line.keys) + std::string(width + 2 - line.keys.size(), ' ') +
                    std::string(line.meaning) + "\n";
        }
    }
    text.pop_back();
    return text;
}

void drawKeyTable(float scale) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 0.5f * display.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowFocus();
    ImGui::SetNextWindowBgAlpha(1.0f);
    if (ImGui::Begin("Keys", nullptr,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav)) {
        if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_SizingFixedFit)) {
            ImGui::TableNextColumn();
            for (std::size_t i = 0; i < kGroups.size(); ++i) {
                if (i == kRightHalf) {
                    ImGui::TableNextColumn();
                    ImGui::Indent(24.0f * scale);
                }
                drawGroup(kGroups[i], (i < kRightHalf ? 170.0f : 90.0f) * scale);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace fluxwalk::ui
