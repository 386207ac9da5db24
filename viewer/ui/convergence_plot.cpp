#include <algorithm>
#include <cfloat>
#include <cmath>
#include <vector>

#include <imgui.h>

#include "viewer/ui/format.h"
#include "viewer/ui/panel.h"
#include "viewer/ui/theme.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

/// A logarithmic axis upwards and a linear one to the right, on a rectangle of the screen.
struct Axes {
    ImVec2 lower;  ///< left, top
    ImVec2 upper;  ///< right, bottom
    double lowestDecade = -3.0;
    double highestDecade = 0.0;
    double seconds = 1.0;

    float x(double time) const {
        return lower.x + (upper.x - lower.x) * static_cast<float>(std::clamp(time / seconds, 0.0, 1.0));
    }
    float y(double value) const {
        const double part =
            (std::log10(std::max(value, 1e-12)) - lowestDecade) / (highestDecade - lowestDecade);
        return upper.y - (upper.y - lower.y) * static_cast<float>(std::clamp(part, 0.0, 1.0));
    }
};

Axes fitAxes(const solve::Statistics& statistics, double target) {
    double least = target;
    double most = target;
    Axes axes;
    axes.seconds = 0.0;
    for (const solve::HistoryEntry& entry : statistics.history) {
        for (const double value : {entry.error, entry.residual}) {
            if (value > 0.0) {
                least = std::min(least, value);
                most = std::max(most, value);
            }
        }
        axes.seconds = std::max(axes.seconds, entry.seconds);
    }
    axes.highestDecade = std::min(2.0, std::ceil(std::log10(most) - 0.05));
    axes.seconds = std::max(axes.seconds, 1e-3);
    // Residuals may fall without end: four decades show what matters.
    axes.lowestDecade = std::clamp(std::floor(std::log10(std::max(least, 1e-12)) - 1e-9),
                                   axes.highestDecade - 4.0, axes.highestDecade - 2.0);
    return axes;
}

void drawLine(const Axes& axes, const solve::Statistics& statistics, double solve::HistoryEntry::*value,
              const ImVec4& color, float thickness) {
    std::vector<ImVec2> points;
    for (const solve::HistoryEntry& entry : statistics.history) {
        if (entry.*value > 0.0) {
            points.emplace_back(axes.x(entry.seconds), axes.y(entry.*value));
        }
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 packed = ImGui::GetColorU32(color);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), packed, 0, thickness);
    if (!points.empty()) {
        list.AddCircleFilled(points.back(), 1.6f * thickness, packed);
    }
}

void drawLegend(const char* text, const ImVec4& color, float scale) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float middle = at.y + 0.5f * ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddLine(ImVec2(at.x, middle), ImVec2(at.x + 14.0f * scale, middle),
                                        ImGui::GetColorU32(color), 2.0f * scale);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 20.0f * scale);
    ImGui::TextColored(kTextDim, "%s", text);
}

}  // namespace

void drawConvergence(const solve::Statistics& statistics, double target, float scale) {
    ImGui::Spacing();
    const float height = 104.0f * scale;
    const float labels = 44.0f * scale;
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::Dummy(ImVec2(width, height));
    explain("Left axis: part of the mean irradiance, in per cent, logarithmic. Right: seconds of solving.");

    Axes axes = fitAxes(statistics, target);
    axes.lower = ImVec2(origin.x + labels, origin.y + 4.0f * scale);
    axes.upper = ImVec2(origin.x + width, origin.y + height - 4.0f * scale);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(axes.lower, axes.upper, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.55f), 3.0f * scale);
    const float small = 0.85f * ImGui::GetFontSize();
    const auto decades = static_cast<int>(std::lround(axes.highestDecade - axes.lowestDecade));
    for (int i = 0; i <= decades; ++i) {
        const double value = std::pow(10.0, axes.lowestDecade + i);
        const float y = axes.y(value);
        list.AddLine(ImVec2(axes.lower.x, y), ImVec2(axes.upper.x, y), ImGui::GetColorU32(ImGuiCol_Separator),
                     1.0f);
        char text[24];
        std::snprintf(text, sizeof text, "%g %%", value * 100.0);
        const ImVec2 size = ImGui::GetFont()->CalcTextSizeA(small, FLT_MAX, 0.0f, text);
        list.AddText(ImGui::GetFont(), small, ImVec2(axes.lower.x - size.x - 6.0f * scale, y - 0.5f * size.y),
                     ImGui::GetColorU32(kTextDim), text);
    }
    const float targetY = axes.y(target);
    const float dash = 4.0f * scale;
    const auto dashes = static_cast<int>(std::ceil((axes.upper.x - axes.lower.x) / (2.0f * dash)));
    for (int i = 0; i < dashes; ++i) {
        const float x = axes.lower.x + 2.0f * dash * static_cast<float>(i);
        list.AddLine(ImVec2(x, targetY), ImVec2(std::min(x + dash, axes.upper.x), targetY),
                     ImGui::GetColorU32(ImGuiCol_Text, 0.7f), 1.0f);
    }
    drawLine(axes, statistics, &solve::HistoryEntry::residual, kCool, 1.5f * scale);
    drawLine(axes, statistics, &solve::HistoryEntry::error, kAccent, 2.0f * scale);

    drawLegend("error", kAccent, scale);
    ImGui::SameLine(0.0f, 14.0f * scale);
    drawLegend("residual", kCool, scale);
    ImGui::SameLine(0.0f, 14.0f * scale);
    drawLegend("target", ImGui::GetStyle().Colors[ImGuiCol_Text], scale);
    const std::string end = statistics.history.empty() ? "" : formatSeconds(axes.seconds);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(end.c_str()).x);
    ImGui::TextColored(kTextDim, "%s", end.c_str());
}

}  // namespace fluxwalk::ui
