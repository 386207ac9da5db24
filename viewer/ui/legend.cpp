#include "viewer/ui/legend.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

constexpr float kBarWidth = 20.0f;
constexpr float kBarHeight = 300.0f;
/// Part of the picture's height that the bar takes at most.
constexpr float kMostOfHeight = 0.4f;
constexpr float kPadding = 12.0f;
constexpr float kGap = 6.0f;
constexpr float kTick = 4.0f;

/// Round numbers as they are: "0.02", "500", "20 000".
std::string formatRound(double number) {
    if (number < 9999.5 || number >= 1e9) {
        return fmt::format("{:g}", number);
    }
    std::string text = fmt::format("{:.0f}", number);
    for (std::size_t at = text.size() - 3; at > 0 && at < text.size(); at -= std::min<std::size_t>(at, 3)) {
        text.insert(at, " ");
    }
    return text;
}

ImU32 pack(const render::Color8& color) {
    return IM_COL32(color[0], color[1], color[2], 255);
}

}  // namespace

Legend makeLegend(const render::DrawSettings& settings, const render::ValueRange& range,
                  const render::ColorMap& map) {
    Legend legend;
    legend.title = settings.shown == render::Shown::luminance    ? "Luminance, cd/m\u00b2"
                   : settings.shown == render::Shown::residual   ? "Residual, lm/m\u00b2"
                   : settings.shown == render::Shown::linkErrors ? "Error of links, lx"
                                                                 : "Illuminance, lx";
    legend.colors.assign(map.colors().begin(), map.colors().end());
    for (const double number : render::roundNumbers(range, settings.scale)) {
        legend.marks.push_back({render::placeOf(number, range, settings.scale), formatRound(number)});
    }
    return legend;
}

Legend makeVisibilityLegend(const render::ColorMap& map) {
    Legend legend;
    legend.title = "Visibility";
    legend.colors.assign(map.colors().begin(), map.colors().end());
    for (int tenths = 0; tenths <= 10; tenths += 2) {
        legend.marks.push_back({0.1 * tenths, fmt::format("{} %", 10 * tenths)});
    }
    return legend;
}

float drawLegend(const Legend& legend, const Canvas& canvas, float fromRight) {
    const float scale = canvas.scale;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    const float barWidth = kBarWidth * scale;
    const float barHeight = std::min(kBarHeight * scale, kMostOfHeight * display.y);
    const float padding = kPadding * scale;
    float labelWidth = 0.0f;
    for (const Legend::Mark& mark : legend.marks) {
        labelWidth = std::max(labelWidth, ImGui::CalcTextSize(mark.label.c_str()).x);
    }
    const ImVec2 title = ImGui::CalcTextSize(legend.title.c_str());
    const float inner = std::max(title.x, barWidth + (kTick + kGap) * scale + labelWidth);
    const ImVec2 size(inner + 2.0f * padding, title.y + barHeight + font + 2.0f * padding);
    const ImVec2 lower(display.x - fromRight - size.x - padding,
                       display.y - canvas.reserved - size.y - padding);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(lower, ImVec2(lower.x + size.x, lower.y + size.y),
                       ImGui::GetColorU32(ImGuiCol_WindowBg, 0.96f), 6.0f * scale);
    list.AddText(ImVec2(lower.x + padding, lower.y + padding), ImGui::GetColorU32(ImGuiCol_Text),
                 legend.title.c_str());

    const ImVec2 bar(lower.x + padding, lower.y + padding + title.y + 0.75f * font);
    const float step = barHeight / static_cast<float>(std::max<std::size_t>(legend.colors.size(), 1));
    for (std::size_t i = 0; i < legend.colors.size(); ++i) {
        const float bottom = bar.y + barHeight - step * static_cast<float>(i);
        list.AddRectFilled(ImVec2(bar.x, bottom - step), ImVec2(bar.x + barWidth, bottom),
                           pack(legend.colors[i]));
    }
    float lastLabel = bar.y + barHeight + 2.0f * font;
    for (const Legend::Mark& mark : legend.marks) {
        const float y = bar.y + barHeight * static_cast<float>(1.0 - mark.place);
        const float right = bar.x + barWidth;
        if (mark.hasTick) {
            list.AddLine(ImVec2(right, y), ImVec2(right + kTick * scale, y), ImGui::GetColorU32(kTextDim),
                         scale);
        }
        if (lastLabel - y >= 1.05f * font) {
            list.AddText(ImVec2(right + (kTick + kGap) * scale, y - 0.5f * font),
                         ImGui::GetColorU32(ImGuiCol_Text), mark.label.c_str());
            lastLabel = y;
        }
    }
    return size.x + padding;
}

}  // namespace fluxwalk::ui
