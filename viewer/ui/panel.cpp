#include "viewer/ui/panel.h"

#include <array>
#include <cfloat>
#include <cmath>

#include <imgui.h>

#include "core/base/photometry.h"
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
    if (info.still.isAtWork) {
        return "Waiting while a still is gathered";
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
        // As high as with buttons, so that nothing below moves away from the mouse.
        const ImVec2 place = ImGui::GetCursorPos();
        ImGui::SetCursorPosY(place.y + 0.5f * (ImGui::GetFrameHeight() - 6.0f * scale));
        ImGui::ProgressBar(1.0f, ImVec2(-FLT_MIN, 6.0f * scale), "");
        ImGui::SetCursorPos(place);
        ImGui::Dummy(ImVec2(0.0f, ImGui::GetFrameHeight()));
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

void drawMovement(Walker& walker) {
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
    beginRow("Field of view", "Vertical angle of the picture. Keys: + and -");
    if (ImGui::SliderScalar("##fov", ImGuiDataType_Double, &degrees, &kNarrowest, &kWidest, "%.0f\u00b0",
                            ImGuiSliderFlags_AlwaysClamp)) {
        walker.setVerticalFov(degrees * base::kPi / 180.0);
    }
}

}  // namespace

float rightOfPanel(const ViewSettings& settings, float scale) {
    return settings.isPanelOpen ? (kMargin + kPanelWidth) * scale : 0.0f;
}

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
            const solve::Statistics none;
            drawConvergence(info.snapshot != nullptr ? info.snapshot->statistics : none, options.error,
                            scale);
        }
        if (info.session && !info.lights.empty() && beginSection("Lights")) {
            actions.changedOptions |= drawLights(info, settings.lights, options);
        }
        if (beginSection("See why")) {
            drawShown(info, settings, options);
        }
        if (beginSection("Picture")) {
            actions.changedOptions |= drawPictureSettings(info, settings, options);
        }
        // Folded at first, so that their headings are seen in a small window.
        if (info.session && beginSection("Still", false)) {
            const double error = info.snapshot != nullptr ? info.snapshot->statistics.estimatedError : -1.0;
            actions.still = drawStillSettings(info.still, settings.still, error);
        }
        if (beginSection("Moving", false)) {
            drawMovement(walker);
        }
        if (beginSection("Places", false)) {
            actions.places = drawPlaces(info.places);
        }
        if (beginSection("Statistics", false)) {
            drawStatistics(info);
        }
    }
    ImGui::End();
    return actions;
}

}  // namespace fluxwalk::ui
