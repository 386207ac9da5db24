#include <array>

#include <imgui.h>

#include "viewer/render/exposure.h"
#include "viewer/ui/format.h"
#include "viewer/ui/option_widget.h"
#include "viewer/ui/panel.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

void drawExposure(ExposureControl& control) {
    beginRow(
        "Exposure",
        "Automatic: the brightest seventh of what is seen is shown just below white, half of it no brighter "
        "than half of white; the middle counts most. Switched off, the exposure stays as it is.");
    ImGui::Checkbox("automatic##exposure", &control.isAutomatic);
    beginRow("", "");
    if (control.isAutomatic) {
        ImGui::PushID("compensation");
        constexpr double kLeast = -5.0;
        constexpr double kMost = 5.0;
        ImGui::SliderScalar("##value", ImGuiDataType_Double, &control.compensation, &kLeast, &kMost,
                            "%+.1f stops");
        ImGui::PopID();
    } else {
        double value = render::exposureValue(control.exposure > 0.0 ? control.exposure : 1.0);
        constexpr double kLeast = -12.0;
        constexpr double kMost = 20.0;
        if (ImGui::SliderScalar("##ev", ImGuiDataType_Double, &value, &kLeast, &kMost, "EV %.1f")) {
            control.exposure = render::exposureFromValue(value);
        }
    }
    if (control.exposure > 0.0) {
        showValue("White at", formatValue(1.0 / control.exposure) + " cd/m\u00b2",
                  "Luminance that the linear curve shows as white.");
    }
}

void drawTone(ViewSettings& settings) {
    constexpr std::array<const char*, 4> kCurves{"Linear", "Filmic", "Reinhard", "Hue"};
    int curve = static_cast<int>(settings.draw.curve);
    beginRow("Tone curve",
             "Linear is true to the light and clips. Filmic rolls off towards white and deepens the dark "
             "tones. Reinhard compresses all highlights. Hue is filmic by the brightest channel: no colour "
             "drifts.");
    if (ImGui::Combo("##curve", &curve, kCurves.data(), static_cast<int>(kCurves.size()))) {
        settings.draw.curve = static_cast<render::ToneCurve>(curve);
    }
    beginRow(
        "Glow",
        "The veil that lenses and eyes spread around lamps: a twentieth of the light, blurred. Draws all "
        "that is seen once more, small.");
    ImGui::Checkbox("around lamps##glow", &settings.draw.glow);
}

}  // namespace

bool drawPictureSettings(const PanelInfo& info, ViewSettings& settings, solve::Options& options) {
    drawExposure(settings.exposure);
    drawTone(settings);
    beginRow(
        "Outlines",
        "Smooth ones take several samples for each pixel. Where that makes pictures slow, they wait until "
        "you stand still.");
    ImGui::Checkbox("smooth##outlines", &settings.smoothEdges);
    return info.session && drawOption("display-angle", "Roundness", options);
}

}  // namespace fluxwalk::ui
