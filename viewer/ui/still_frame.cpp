#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "viewer/ui/still.h"
#include "viewer/ui/theme.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

/// At 96 dpi: the box that a small still fits into, gaps, and the bar of a large one.
constexpr float kSmallWidth = 336.0f;
constexpr float kSmallHeight = 252.0f;
constexpr float kMargin = 14.0f;
constexpr float kBarWidth = 540.0f;
constexpr float kThickness = 6.0f;
constexpr float kLeastSide = 8.0f;

// Pixels of a picture of these proportions within a box.
StillPlace fit(gl::PixelSize size, float width, float height) {
    const float scale = std::min(width / static_cast<float>(std::max(1, size.width)),
                                 height / static_cast<float>(std::max(1, size.height)));
    return {0.0f, 0.0f, std::max(kLeastSide, std::round(scale * static_cast<float>(size.width))),
            std::max(kLeastSide, std::round(scale * static_cast<float>(size.height)))};
}

void drawButtons(const StillInfo& info, StillActions& actions) {
    if (!info.isOver) {
        actions.cancels = ImGui::Button("Cancel");
        explain("Ends it with what is done, which can be saved.");
    } else {
        ImGui::BeginDisabled(!info.canBeKept);
        actions.keepsPicture = ImGui::Button("Save PNG");
        explain(
            "The picture as it is shown, to the folder where the program was started. Key: F12 while it is "
            "large");
        ImGui::SameLine();
        actions.keepsLight = ImGui::Button("Save EXR");
        explain(
            "Linear light in cd/m\u00b2 with the layers irradiance, albedo, normal and object. Key: Shift "
            "F12 while it is large");
        ImGui::EndDisabled();
    }
    ImGui::SameLine();
    actions.resizes = ImGui::Button(info.isLarge ? "Small" : "Large");
    explain("Over the whole window, or in a corner, where it goes by itself when you walk on. Key: T");
    if (info.isOver) {
        ImGui::SameLine();
        actions.closes = ImGui::Button("Close");
        explain("Forgets it. Key: Esc");
    }
}

void drawTold(const StillInfo& info, float width, float scale) {
    ImGui::TextColored(kTextDim, "%d x %d   %s", info.size.width, info.size.height, info.told.c_str());
    ImGui::ProgressBar(static_cast<float>(info.progress), ImVec2(width, kThickness * scale), "");
}

StillActions drawSmall(const StillInfo& info, void* texture, const Canvas& canvas) {
    StillActions actions;
    const float margin = kMargin * canvas.scale;
    ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - margin, margin), ImGuiCond_Appearing,
                            ImVec2(1.0f, 0.0f));
    if (ImGui::Begin("Still##small", nullptr,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav)) {
        const StillPlace place = placeSmall(info.size, canvas.scale);
        const float room = kSmallWidth * canvas.scale;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::floor(0.5f * (room - place.width)));
        ImGui::Image(texture, ImVec2(place.width, place.height), ImVec2(0.0f, 1.0f), ImVec2(1.0f, 0.0f));
        actions.resizes = ImGui::IsItemClicked();
        drawTold(info, room, canvas.scale);
        StillActions pressed;
        drawButtons(info, pressed);
        actions.add(pressed);
    }
    ImGui::End();
    return actions;
}

StillActions drawLarge(const StillInfo& info, void* texture, const Canvas& canvas) {
    StillActions actions;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const StillPlace place = placeLarge(info.size);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(ImVec2(0.0f, 0.0f), display, IM_COL32(0, 0, 0, 255));
    list.AddImage(texture, ImVec2(place.left, place.top),
                  ImVec2(place.left + place.width, place.top + place.height), ImVec2(0.0f, 1.0f),
                  ImVec2(1.0f, 0.0f));
    const float room = display.x - canvas.left;
    const float width = std::min(kBarWidth * canvas.scale, room);
    ImGui::SetNextWindowPos(
        ImVec2(canvas.left + 0.5f * room, display.y - canvas.reserved - kMargin * canvas.scale),
        ImGuiCond_Always, ImVec2(0.5f, 1.0f));
    ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
    ImGui::SetNextWindowBgAlpha(0.9f);
    if (ImGui::Begin("##still", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                         ImGuiWindowFlags_NoFocusOnAppearing)) {
        drawTold(info, -1.0f, canvas.scale);
        drawButtons(info, actions);
    }
    ImGui::End();
    return actions;
}

}  // namespace

StillPlace placeLarge(gl::PixelSize size) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    StillPlace place = fit(size, display.x, display.y);
    place.left = std::floor(0.5f * (display.x - place.width));
    place.top = std::floor(0.5f * (display.y - place.height));
    return place;
}

StillPlace placeSmall(gl::PixelSize size, float scale) {
    return fit(size, kSmallWidth * scale, kSmallHeight * scale);
}

StillActions drawStill(const StillInfo& info, void* texture, const Canvas& canvas) {
    return info.isLarge ? drawLarge(info, texture, canvas) : drawSmall(info, texture, canvas);
}

}  // namespace fluxwalk::ui
