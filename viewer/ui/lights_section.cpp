#include <array>
#include <cmath>

#include <imgui.h>

#include "core/base/photometry.h"
#include "viewer/ui/format.h"
#include "viewer/ui/panel.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

constexpr double kMostPercent = 400.0;
/// More lights than this scroll in a field of their own.
constexpr std::size_t kManyLights = 8;

const char* unitOf(const scene::LightSource& source, const scene::Scene& scene) {
    switch (source.kind) {
        case scene::LightSource::Kind::material:
            return "lm/m\u00b2";
        case scene::LightSource::Kind::light:
            return scene.lights[source.index].kind == scene::LightKind::directional ? "lx" : "cd";
        case scene::LightSource::Kind::sky:
            break;
    }
    return "lx";
}

std::string explainLight(const scene::LightSource& source, const scene::Scene& scene) {
    const char* kind = source.kind == scene::LightSource::Kind::material ? "Glowing material"
                       : source.kind == scene::LightSource::Kind::light  ? "Light"
                                                                         : "Sky";
    const auto value = static_cast<double>(base::luminance(source.emitted));
    return source.name + "\n" + kind + " of " + formatValue(value) + " " + unitOf(source, scene) +
           ".\nSwitch, dim (0 to 400 %, Ctrl-click to type) or tint it: the light follows at once over the "
           "links "
           "that stand, then they are refined for it.";
}

// The picker shows colours as screens do; factors are linear.
bool pickColor(scene::Rgb& color) {
    std::array<float, 3> shown{};
    for (int c = 0; c < 3; ++c) {
        shown[static_cast<std::size_t>(c)] = std::pow(color[c], 1.0f / 2.2f);
    }
    if (!ImGui::ColorEdit3("##tint", shown.data(),
                           ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel |
                               ImGuiColorEditFlags_PickerHueWheel)) {
        return false;
    }
    for (int c = 0; c < 3; ++c) {
        color[c] = std::pow(std::clamp(shown[static_cast<std::size_t>(c)], 0.0f, 1.0f), 2.2f);
    }
    return true;
}

bool drawLight(const scene::LightSource& source, const scene::Scene& scene, LightControl& control) {
    bool isChanged = ImGui::Checkbox("##on", &control.isOn);
    const std::string explanation = explainLight(source, scene);
    explain(explanation.c_str());
    ImGui::SameLine();
    beginRow(source.name.c_str(), explanation.c_str());
    const float square = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(-square);
    ImGui::BeginDisabled(!control.isOn);
    double percent = 100.0 * control.level;
    if (slideLogarithmic("##level", percent, 0.0, kMostPercent, "%.0f %%")) {
        control.level = percent / 100.0;
        isChanged = true;
    }
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    isChanged |= pickColor(control.color);
    explain("Tint");
    ImGui::EndDisabled();
    return isChanged;
}

}  // namespace

bool drawLights(const PanelInfo& info, std::vector<LightControl>& controls, solve::Options& options) {
    controls.resize(info.lights.size());
    const bool isLong = info.lights.size() > kManyLights;
    if (isLong) {
        const float height = ImGui::GetFrameHeightWithSpacing() * static_cast<float>(kManyLights);
        ImGui::BeginChild("##lights", ImVec2(0.0f, height));
    }
    bool isChanged = false;
    for (std::size_t i = 0; i < info.lights.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (drawLight(info.lights[i], *info.scene, controls[i])) {
            scene::setFactor(options.lighting, info.lights[i], controls[i].factor());
            isChanged = true;
        }
        ImGui::PopID();
    }
    if (isLong) {
        ImGui::EndChild();
    }
    // Always there, so that nothing below moves away from the mouse.
    ImGui::BeginDisabled(options.lighting.isNeutral());
    if (ImGui::Button("As in the scene")) {
        options.lighting = {};
        controls = controlsOf(info.lights, {});
        isChanged = true;
    }
    ImGui::EndDisabled();
    return isChanged;
}

}  // namespace fluxwalk::ui
