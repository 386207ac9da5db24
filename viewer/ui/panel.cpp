#include "viewer/ui/panel.h"

#include <array>
#include <cfloat>
#include <cmath>

#include <imgui.h>

#include "core/base/photometry.h"
#include "viewer/render/exposure.h"
#include "viewer/ui/format.h"
#include "viewer/ui/option_widget.h"
#include "viewer/ui/theme.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

constexpr float kPanelWidth = 348.0f;
constexpr float kMargin = 14.0f;

std::string describeFailure(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const std::exception& error) {
        return error.what();
    } catch (...) {
        return "unknown failure";
    }
}

std::string describeOutcome(solve::Outcome outcome) {
    switch (outcome) {
        case solve::Outcome::reachedTimeLimit:
            return "Stopped at the time limit";
        case solve::Outcome::reachedLinkLimit:
            return "Stopped at the link limit";
        case solve::Outcome::reachedMemoryLimit:
            return "Stopped at the memory limit";
        default:
            return "Requested error reached";
    }
}

std::string describePhase(const PanelInfo& info) {
    if (!info.session) {
        return "Lit file: shown as it was solved";
    }
    switch (info.session->phase) {
        case session::Phase::solving:
            if (info.session->isStepping) {
                return "One level: " + info.session->stage;
            }
            if (info.isPaused) {
                return "Pausing";
            }
            return info.session->stage.empty() ? "Solving" : "Solving: " + info.session->stage;
        case session::Phase::paused:
            return "Paused";
        case session::Phase::finished:
            return describeOutcome(info.session->outcome);
        case session::Phase::stopped:
            return "Stopped";
        case session::Phase::failed:
            break;
    }
    return "Failed: " + describeFailure(info.session->failure);
}

void drawProgress(const PanelInfo& info, PanelActions& actions, float scale) {
    const bool failed = info.session && info.session->phase == session::Phase::failed;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(failed ? kWarning : kTextDim, "%s", describePhase(info).c_str());
    ImGui::PopTextWrapPos();
    if (!info.session || failed) {
        return;
    }
    const bool isFinished = info.session->phase == session::Phase::finished;
    if (isFinished) {
        ImGui::ProgressBar(1.0f, ImVec2(-FLT_MIN, 6.0f * scale), "");
        return;
    }
    const float buttonWidth = 84.0f * scale;
    const float stepWidth = 54.0f * scale;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float buttons = buttonWidth + gap + (info.isPaused ? stepWidth + gap : 0.0f);
    const float height = ImGui::GetFrameHeight();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.5f * (height - 6.0f * scale));
    ImGui::ProgressBar(static_cast<float>(info.session->progress),
                       ImVec2(ImGui::GetContentRegionAvail().x - buttons, 6.0f * scale), "");
    ImGui::SameLine();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 0.5f * (height - 6.0f * scale));
    if (info.isPaused) {
        actions.steps = ImGui::Button("Step", ImVec2(stepWidth, 0.0f));
        explain("Solves one level further: refines the links once and sweeps. Key: N");
        ImGui::SameLine();
    }
    if (ImGui::Button(info.isPaused ? "Continue" : "Pause", ImVec2(buttonWidth, 0.0f))) {
        actions.togglesPause = true;
    }
    explain("Holds the solver at the next wave of links; the solution so far stays. Key: P");
}

void drawExposure(ViewSettings& settings) {
    ExposureControl& control = settings.exposure;
    beginRow(
        "Exposure",
        "Automatic: the brightest seventh of what is seen, most of it in the middle, is shown just below "
        "white. Switched off, the exposure stays as it is.");
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

void drawMovement(const PanelInfo& info, ViewSettings& settings, Walker& walker, PanelActions& actions) {
    int movement = static_cast<int>(walker.movement);
    constexpr std::array<const char*, 2> kMovements{"Walk", "Fly"};
    beginRow("Movement", "Walk stays at eye height above the floor, fly goes where you look. Key: F");
    if (ImGui::Combo("##movement", &movement, kMovements.data(), static_cast<int>(kMovements.size()))) {
        walker.movement = static_cast<Movement>(movement);
    }
    if (walker.movement == Movement::walk) {
        beginRow("Eye height", "Of the eyes above the floor. Keys: E and Q");
        slideLogarithmic("##eyes", walker.eyeHeight, 0.05, 20.0, "%.2f m");
    }
    beginRow("Speed", "Shift is three times as fast, Ctrl a quarter. The mouse wheel changes it.");
    slideLogarithmic("##speed", walker.speed, 0.01, 100.0, "%.2f m/s");
    double degrees = walker.verticalFov() * 180.0 / base::kPi;
    constexpr double kNarrowest = 15.0;
    constexpr double kWidest = 110.0;
    beginRow("Field of view", "Vertical angle of the picture.");
    if (ImGui::SliderScalar("##fov", ImGuiDataType_Double, &degrees, &kNarrowest, &kWidest, "%.0f\u00b0",
                            ImGuiSliderFlags_AlwaysClamp)) {
        walker.setVerticalFov(degrees * base::kPi / 180.0);
    }
    beginRow("Edges",
             "Smooth edges cost time where the processor draws; there they wait until you stand still.");
    ImGui::Checkbox("smooth", &settings.smoothEdges);
    if (!info.scene->cameras.empty()) {
        beginRow("Cameras", "Go to a camera of the scene.");
        if (ImGui::BeginCombo("##cameras", "go to ...")) {
            for (std::size_t i = 0; i < info.scene->cameras.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                const std::string& name = info.scene->cameras[i].name;
                if (ImGui::Selectable(name.empty() ? "(unnamed)" : name.c_str())) {
                    actions.camera = static_cast<int>(i);
                }
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
    }
}

}  // namespace

PanelActions drawPanel(const PanelInfo& info, ViewSettings& settings, solve::Options& options, Walker& walker,
                       float scale) {
    PanelActions actions;
    if (!settings.isPanelOpen) {
        return actions;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float margin = kMargin * scale;
    ImGui::SetNextWindowPos(ImVec2(margin, margin), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(
        ImVec2(kPanelWidth * scale, 0.0f),
        ImVec2(kPanelWidth * scale, std::max(100.0f, display.y - 2.0f * margin)));
    const std::string title = (info.scene->name.empty() ? "Fluxwalk" : info.scene->name) + "###panel";
    if (ImGui::Begin(title.c_str(), nullptr,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing)) {
        drawProgress(info, actions, scale);
        if (info.session && beginSection("Solution")) {
            actions.changedOptions |= drawSolution(info, options);
            if (info.snapshot != nullptr) {
                drawConvergence(info.snapshot->statistics, options.error, scale);
            }
        }
        if (info.session && !info.lights.empty() && beginSection("Lights")) {
            actions.changedOptions |= drawLights(info, settings.lights, options);
        }
        if (beginSection("See why")) {
            drawShown(info, settings);
        }
        if (beginSection("Light and tone")) {
            drawExposure(settings);
        }
        if (beginSection("View")) {
            if (info.session) {
                actions.changedOptions |= drawOption("display-angle", "Roundness", options);
            }
            drawMovement(info, settings, walker, actions);
        }
        if (beginSection("Places")) {
            actions.places = drawPlaces(info.places);
        }
        if (beginSection("Statistics")) {
            drawStatistics(info);
        }
    }
    ImGui::End();
    return actions;
}

void drawKeys(bool isCaptured, Movement movement, float scale) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const char* look = isCaptured ? "mouse look    Esc release" : "right drag look    Tab capture";
    const char* other = movement == Movement::walk ? "F fly" : "F walk";
    ImGui::SetNextWindowPos(ImVec2(display.x - kMargin * scale, display.y - kMargin * scale),
                            ImGuiCond_Always, ImVec2(1.0f, 1.0f));
    ImGui::SetNextWindowBgAlpha(0.75f);
    if (ImGui::Begin("##keys", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoNav)) {
        ImGui::TextColored(kTextDim,
                           "F1 all keys    WASD move    %s    %s    C lux    I inspect    P pause    H panel",
                           look, other);
    }
    ImGui::End();
}

}  // namespace fluxwalk::ui
