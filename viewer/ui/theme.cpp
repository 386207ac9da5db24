#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

ImVec4 grey(float value, float alpha = 1.0f) {
    return {value, value, value + 0.004f, alpha};
}

}  // namespace

void applyTheme(float scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowPadding = {14.0f, 12.0f};
    style.FramePadding = {8.0f, 4.0f};
    style.ItemSpacing = {8.0f, 6.0f};
    style.ItemInnerSpacing = {6.0f, 4.0f};
    style.CellPadding = {4.0f, 2.0f};
    style.ScrollbarSize = 10.0f;
    style.GrabMinSize = 10.0f;
    style.WindowRounding = 6.0f;
    style.FrameRounding = 4.0f;
    style.GrabRounding = 3.0f;
    style.PopupRounding = 4.0f;
    style.ScrollbarRounding = 5.0f;
    style.WindowBorderSize = 1.0f;
    style.PopupBorderSize = 1.0f;
    style.FrameBorderSize = 0.0f;
    style.WindowTitleAlign = {0.0f, 0.5f};
    style.WindowMenuButtonPosition = ImGuiDir_None;

    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = grey(0.90f);
    colors[ImGuiCol_TextDisabled] = kTextDim;
    colors[ImGuiCol_WindowBg] = grey(0.095f, 0.96f);
    colors[ImGuiCol_PopupBg] = grey(0.12f, 0.98f);
    colors[ImGuiCol_Border] = grey(0.22f);
    colors[ImGuiCol_FrameBg] = grey(0.17f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.22f);
    colors[ImGuiCol_FrameBgActive] = grey(0.25f);
    colors[ImGuiCol_TitleBg] = grey(0.095f);
    colors[ImGuiCol_TitleBgActive] = grey(0.12f);
    colors[ImGuiCol_TitleBgCollapsed] = grey(0.095f, 0.8f);
    colors[ImGuiCol_ScrollbarBg] = grey(0.095f, 0.0f);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.28f);
    colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.36f);
    colors[ImGuiCol_ScrollbarGrabActive] = grey(0.42f);
    colors[ImGuiCol_CheckMark] = kAccent;
    // Pale enough to read the value through it.
    colors[ImGuiCol_SliderGrab] = {kAccent.x, kAccent.y, kAccent.z, 0.38f};
    colors[ImGuiCol_SliderGrabActive] = {kAccent.x, kAccent.y, kAccent.z, 0.6f};
    colors[ImGuiCol_Button] = grey(0.20f);
    colors[ImGuiCol_ButtonHovered] = grey(0.27f);
    colors[ImGuiCol_ButtonActive] = grey(0.32f);
    colors[ImGuiCol_Header] = grey(0.095f, 0.0f);
    colors[ImGuiCol_HeaderHovered] = grey(0.18f);
    colors[ImGuiCol_HeaderActive] = grey(0.22f);
    colors[ImGuiCol_Separator] = grey(0.20f);
    colors[ImGuiCol_PlotHistogram] = kAccent;
    colors[ImGuiCol_ResizeGrip] = grey(0.28f, 0.0f);
    colors[ImGuiCol_ResizeGripHovered] = grey(0.34f);
    colors[ImGuiCol_ResizeGripActive] = grey(0.40f);
    colors[ImGuiCol_NavHighlight] = kAccent;
    colors[ImGuiCol_TextSelectedBg] = {kAccent.x, kAccent.y, kAccent.z, 0.35f};

    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

}  // namespace fluxwalk::ui
