#include "viewer/ui/widgets.h"

#include <cfloat>

#include <imgui.h>

#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

/// Where widgets begin, as a part of the panel's width.
constexpr float kLabelPart = 0.40f;

}  // namespace

bool beginSection(const char* title, bool isOpenAtFirst) {
    ImGui::Spacing();
    ImGui::PushStyleColor(ImGuiCol_Text, kAccent);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        ImVec2(0.3f * ImGui::GetStyle().FramePadding.x, ImGui::GetStyle().FramePadding.y));
    const bool isOpen = ImGui::CollapsingHeader(
        title, isOpenAtFirst ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    return isOpen;
}

void beginRow(const char* label, const char* explanation) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    explain(explanation);
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + ImGui::GetWindowContentRegionMax().x * kLabelPart);
    ImGui::SetNextItemWidth(-FLT_MIN);
}

void showValue(const char* label, const std::string& value, const char* explanation) {
    ImGui::TextColored(kTextDim, "%s", label);
    explain(explanation);
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    ImGui::TextUnformatted(value.c_str());
}

void explain(const char* explanation) {
    if (!ImGui::IsItemHovered()) {
        return;
    }
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0f);
    ImGui::TextUnformatted(explanation);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool slideLogarithmic(const char* id, double& value, double least, double most, const char* format) {
    return ImGui::SliderScalar(id, ImGuiDataType_Double, &value, &least, &most, format,
                               ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

}  // namespace fluxwalk::ui
