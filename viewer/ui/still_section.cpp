#include <array>

#include <imgui.h>

#include "core/image/still_options.h"
#include "viewer/ui/format.h"
#include "viewer/ui/still.h"
#include "viewer/ui/theme.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

struct SizeChoice {
    const char* name;
    gl::PixelSize size;
};
constexpr std::array kSizes{
    SizeChoice{"as the window", {0, 0}},          SizeChoice{"1280 x 720", {1280, 720}},
    SizeChoice{"1920 x 1080", {1920, 1080}},      SizeChoice{"2560 x 1440", {2560, 1440}},
    SizeChoice{"3840 x 2160 (4k)", {3840, 2160}}, SizeChoice{"7680 x 4320 (8k)", {7680, 4320}},
    SizeChoice{"2048 x 2048", {2048, 2048}}};

void chooseSize(gl::PixelSize& size) {
    beginRow(
        "Size",
        "Pixels of the still. The height shows what the window's shows; a still that is wider shows more. "
        "Takes 40 bytes a pixel while it is there: .3 GB at 4k.");
    const auto* chosen = &kSizes[0];
    for (const SizeChoice& choice : kSizes) {
        chosen = choice.size == size ? &choice : chosen;
    }
    if (ImGui::BeginCombo("##size", chosen->name)) {
        for (const SizeChoice& choice : kSizes) {
            if (ImGui::Selectable(choice.name, &choice == chosen)) {
                size = choice.size;
            }
        }
        ImGui::EndCombo();
    }
}

void chooseNumber(const char* label, std::string_view name, image::StillOptions& options) {
    const image::StillOptionInfo& option = image::stillOption(name);
    const std::string text =
        std::string(option.explanation) + "\n\nRange: " + std::to_string(option.minimum) + " to " +
        std::to_string(option.maximum) + ".\nDefault: " + std::to_string(option.defaultValue()) + ".";
    ImGui::PushID(label);
    beginRow(label, text.c_str());
    unsigned value = option.get(options);
    if (ImGui::SliderScalar("##value", ImGuiDataType_U32, &value, &option.minimum, &option.maximum, "%u",
                            ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
        option.set(options, value);
    }
    ImGui::PopID();
}

}  // namespace

void StillActions::add(const StillActions& other) {
    takes |= other.takes;
    cancels |= other.cancels;
    closes |= other.closes;
    resizes |= other.resizes;
    keepsPicture |= other.keepsPicture;
    keepsLight |= other.keepsLight;
}

StillActions drawStillSettings(const StillInfo& info, StillSettings& settings, double estimatedError) {
    StillActions actions;
    chooseSize(settings.size);
    chooseNumber("Samples", "samples", settings.options);
    chooseNumber("Shadow rays", "shadow-rays", settings.options);
    beginRow("Exposure",
             "Its own: metered on the still once it is done, as render does. Otherwise that of the window, "
             "which it follows.");
    ImGui::Checkbox("its own##exposure", &settings.hasOwnExposure);
    if (estimatedError >= 0.0) {
        showValue("Solution's error", formatPercent(estimatedError),
                  "Of the solution that the still is gathered from, estimated. The still's is several times "
                  "smaller; 3 % is enough.");
    }
    beginRow("", "");
    const bool isMaking = info.isThere && !info.isOver;
    if (isMaking) {
        actions.cancels = ImGui::Button("Cancel##still", ImVec2(-1.0f, 0.0f));
        explain("Ends it with what is done, which can be saved.");
    } else {
        actions.takes = ImGui::Button("Render", ImVec2(-1.0f, 0.0f));
        explain(
            "Gathers the light anew at every pixel of this view. The solver waits meanwhile and then goes on "
            "as if nothing had been; so does what you turn. Key: T");
    }
    return actions;
}

}  // namespace fluxwalk::ui
