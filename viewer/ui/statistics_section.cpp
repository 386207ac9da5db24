#include <imgui.h>

#include "core/base/photometry.h"
#include "viewer/ui/format.h"
#include "viewer/ui/panel.h"
#include "viewer/ui/theme.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

/// Photometric value of a flux whose channels carry their own lumens.
std::string lumens(const base::Vec3d& flux) {
    return formatValue(static_cast<double>(base::luminance(base::Rgb(flux)))) + " lm";
}

void drawSolved(const solve::Statistics& s) {
    if (s.estimatedError >= 0.0) {
        showValue("Estimated error", formatPercent(s.estimatedError),
                  "RMS error of the irradiance as a part of its mean, estimated by gathering at points.");
    }
    showValue("Residual", formatPercent(s.residual), "Part of the power that the last sweep still moved.");
    showValue("Threshold", formatValue(s.threshold) + " lx", "Largest error of one link at this moment.");
    showValue("Mean illuminance", formatValue(s.meanIrradiance) + " lx",
              "Mean of the channels over all sides that light reaches.");
    ImGui::Separator();
    showValue("Links", formatCount(s.counters.links) + "   " + formatBytes(s.counters.bytesLinks),
              "Pairs of nodes that exchange light.");
    showValue("Leaves", formatCount(s.counters.leaves), "Smallest elements: those that are shown.");
    showValue("Nodes", formatCount(s.counters.nodes) + "   " + formatBytes(s.counters.bytesNodes),
              "Clusters, patches and elements.");
    showValue("Rays", formatCount(s.counters.rays), "Rays cast for visibility.");
    ImGui::Separator();
    showValue("Emitted", lumens(s.audit.emitted), "Light of all emitters, photometric.");
    showValue("Absorbed", lumens(s.audit.absorbed), "Light that ends in surfaces.");
    if (!s.audit.isClosed) {
        showValue("Escaped", lumens(s.audit.escaped),
                  "Light that leaves the scene, counted by its own rays.");
    }
    showValue("Energy defect", formatPercent(s.audit.relativeDefect()),
              "What is neither absorbed nor escaped, as a part of the emitted light.");
    ImGui::Separator();
    showValue("Solving time", formatSeconds(s.times.total), "Since the start, without pauses.");
    const std::pair<const char*, double> stages[] = {
        {"refining", s.times.refine},
        {"sweeps", s.times.sweep},
        {"display meshes", s.times.display},
    };
    for (const auto& [name, seconds] : stages) {
        if (seconds > 0.0) {
            showValue((std::string("   ") + name).c_str(), formatSeconds(seconds),
                      "Part of the solving time.");
        }
    }
}

}  // namespace

void drawStatistics(const PanelInfo& info) {
    if (info.session && info.snapshot != nullptr) {
        drawSolved(info.snapshot->statistics);
        ImGui::Separator();
    }
    showValue("Triangles", formatCount(info.triangleCount), "Drawn for this picture, all sides.");
    showValue("Pictures", info.framesPerSecond > 0.0 ? formatValue(info.framesPerSecond) + " /s" : "still",
              "Drawn only when something changes.");
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(kTextDim, "%s", info.renderer.c_str());
    ImGui::PopTextWrapPos();
}

}  // namespace fluxwalk::ui
