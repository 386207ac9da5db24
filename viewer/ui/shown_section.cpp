#include <array>
#include <cmath>

#include <imgui.h>

#include "viewer/ui/panel.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

/// Ends that a range may be given, in lux or cd/m2, and how far apart they must be.
constexpr double kLeastEnd = 1e-3;
constexpr double kMostEnd = 1e6;
constexpr double kLeastRatio = 1.01;

void drawRange(const PanelInfo& info, render::DrawSettings& draw) {
    bool isAutomatic = !draw.range;
    beginRow("Range",
             "Values of the first and the last colour. Automatic: round numbers about what is seen.");
    if (ImGui::Checkbox("automatic##range", &isAutomatic)) {
        draw.range = isAutomatic ? std::nullopt : std::optional(info.shownRange);
    }
    if (!draw.range) {
        return;
    }
    const char* format = draw.shown == render::Shown::luminance ? "%.3g cd/m\u00b2" : "%.3g lx";
    beginRow("   from", "Value of the first colour.");
    const bool isLinear = draw.scale == render::ValueScale::linear;
    slideLogarithmic("##least", draw.range->least, isLinear ? 0.0 : kLeastEnd, kMostEnd / kLeastRatio,
                     format);
    beginRow("   to", "Value of the last colour.");
    slideLogarithmic("##most", draw.range->most, kLeastRatio * kLeastEnd, kMostEnd, format);
    draw.range->most = std::max(draw.range->most, kLeastRatio * std::max(draw.range->least, kLeastEnd));
}

}  // namespace

void drawShown(const PanelInfo& info, render::DrawSettings& draw) {
    constexpr std::array<const char*, 3> kKinds{"Picture", "Illuminance", "Luminance"};
    int kind = static_cast<int>(draw.shown);
    beginRow(
        "Show",
        "Picture: as a camera sees it. Illuminance: light that arrives, in lux. Luminance: brightness of "
        "the surfaces, in cd/m\u00b2. Key: C");
    if (ImGui::Combo("##shown", &kind, kKinds.data(), static_cast<int>(kKinds.size()))) {
        draw.shown = static_cast<render::Shown>(kind);
        draw.range.reset();
    }
    if (draw.shown == render::Shown::picture) {
        return;
    }
    constexpr std::array<const char*, 2> kScales{"Logarithmic", "Linear"};
    int scale = static_cast<int>(draw.scale);
    beginRow("Scale", "Logarithmic: equal ratios have equal steps of colour. Linear: equal differences.");
    if (ImGui::Combo("##scale", &scale, kScales.data(), static_cast<int>(kScales.size()))) {
        draw.scale = static_cast<render::ValueScale>(scale);
        draw.range.reset();
    }
    drawRange(info, draw);
    beginRow("Isolines", "Lines of equal value at the round numbers of the legend.");
    ImGui::Checkbox("lines##isolines", &draw.isolines);
}

}  // namespace fluxwalk::ui
