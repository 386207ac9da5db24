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
constexpr std::array kStills{KeyLine{"T", "gather a still; large or in a corner"},
                             KeyLine{"Esc", "still to the corner, or closed if done"},
                             KeyLine{"F12, Shift F12", "keep a large still as PNG, as EXR"}};
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
                             KeyGroup{"Stills", kStills}, KeyGroup{"Places and paths", kPlaces},
                             KeyGroup{"Seeing", kSeeing}, KeyGroup{"Window", kWindow}};
/// Groups from here on stand in the right half of the window's help.
constexpr std::size_t kRightHalf = 3;

/// At 96 dpi.
constexpr float kMargin = 14.0f;
constexpr float kKeyGap = 24.0f;

using Groups = std::span<const KeyGroup>;

Groups leftHalf() {
    return Groups(kGroups).first(kRightHalf);
}
Groups rightHalf() {
    return Groups(kGroups).subspan(kRightHalf);
}

float widthOf(std::string_view text) {
    return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

/// Pixels that the column of keys, and that of their meanings, take in one half of the help.
struct Columns {
    float keys = 0.0f;
    float meanings = 0.0f;
};

Columns columnsOf(Groups groups, float gap) {
    Columns columns;
    for (const KeyGroup& group : groups) {
        for (const KeyLine& line : group.lines) {
            columns.keys = std::max(columns.keys, widthOf(line.keys) + gap);
            columns.meanings = std::max(columns.meanings, widthOf(line.meaning));
        }
    }
    return columns;
}

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
    const float gap = kKeyGap * scale;
    const Columns left = columnsOf(leftHalf(), gap);
    const Columns right = columnsOf(rightHalf(), gap);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float natural = left.keys + left.meanings + gap + right.keys + right.meanings +
                          2.0f * style.WindowPadding.x + 4.0f * style.CellPadding.x;
    // A small window gets small letters rather than half a table.
    const float fit = std::min(1.0f, (display.x - 2.0f * kMargin * scale) / natural);
    ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 0.5f * display.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowFocus();
    ImGui::SetNextWindowBgAlpha(1.0f);
    if (ImGui::Begin("Keys", nullptr,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav)) {
        ImGui::SetWindowFontScale(fit);
        if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_SizingFixedFit)) {
            ImGui::TableNextColumn();
            for (const KeyGroup& group : leftHalf()) {
                drawGroup(group, fit * left.keys);
            }
            ImGui::TableNextColumn();
            ImGui::Indent(fit * gap);
            for (const KeyGroup& group : rightHalf()) {
                drawGroup(group, fit * right.keys);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

void drawKeys(const KeyHints& hints, float left, float scale) {
    const char* look = hints.isCaptured ? "mouse look" : "right drag look";
    const char* capture = hints.isCaptured ? "Esc release" : "Tab capture";
    // The first are needed first; those that do not fit beside the panel are left to F1.
    const std::array<const char*, 10> all{
        "F1 all keys", "WASD move", look,      hints.isPanelOpen ? "H hide panel" : "H panel", "C lux",
        "I inspect",   "P pause",   "T still", hints.isWalking ? "F fly" : "F walk",           capture};
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float margin = kMargin * scale;
    const float room = display.x - left - 2.0f * margin - 2.0f * ImGui::GetStyle().WindowPadding.x;
    const float gap = 18.0f * scale;
    ImGui::SetNextWindowPos(ImVec2(display.x - margin, display.y - margin), ImGuiCond_Always,
                            ImVec2(1.0f, 1.0f));
    ImGui::SetNextWindowBgAlpha(0.75f);
    if (ImGui::Begin("##keys", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoNav)) {
        float used = 0.0f;
        for (const char* hint : all) {
            const float width = widthOf(hint);
            if (used > 0.0f && used + gap + width > room) {
                break;
            }
            if (used > 0.0f) {
                ImGui::SameLine(0.0f, gap);
            }
            ImGui::TextColored(kTextDim, "%s", hint);
            used += (used > 0.0f ? gap : 0.0f) + width;
        }
    }
    ImGui::End();
}

}  // namespace fluxwalk::ui
