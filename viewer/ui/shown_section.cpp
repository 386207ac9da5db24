#include <array>
#include <cmath>

#include <imgui.h>

#include "viewer/ui/format.h"
#include "viewer/ui/option_widget.h"
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

void drawValues(const PanelInfo& info, render::DrawSettings& draw) {
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

// The solver need not go on for it: what is shown follows the option by itself.
void drawLightOfDisplay(const session::Status& status, solve::Options& options) {
    drawOption("display", "Light", options);
    const session::GatherProgress& gathered = status.gathered;
    if (options.display != solve::DisplayLight::gathered) {
        return;
    }
    std::string text = "while the solver rests";
    if (gathered.leaves > 0 && gathered.done == gathered.leaves) {
        text = "all";
    } else if (gathered.leaves > 0) {
        const double part = 100.0 * static_cast<double>(gathered.done) / static_cast<double>(gathered.leaves);
        text = (gathered.seenPending > 0 ? "" : "all that is seen, ") + formatValue(part) + " %";
    }
    showValue("   gathered", text,
              "Elements whose light is found at their vertices, those that are seen first. Pause the solver "
              "to have it gathered before it ends.");
}

// What only a solution that is here can tell.
void drawOverlays(ViewSettings& settings) {
    render::DrawSettings& draw = settings.draw;
    beginRow("Elements",
             "The edges of the elements: leaves of the solution, smallest where the light changes.");
    ImGui::Checkbox("edges##elements", &draw.elementEdges);
    beginRow(
        "Clusters",
        "Boxes of the clusters that are so many steps below the whole scene. Links may end at any of them.");
    ImGui::Checkbox("boxes##clusters", &draw.clusterBoxes);
    if (draw.clusterBoxes) {
        beginRow("   steps", "0: the whole scene. Each step parts a cluster into two.");
        int depth = static_cast<int>(draw.clusterDepth);
        constexpr int kDeepest = 20;
        if (ImGui::SliderInt("##depth", &depth, 0, kDeepest, "%d", ImGuiSliderFlags_AlwaysClamp)) {
            draw.clusterDepth = static_cast<unsigned>(depth);
        }
    }
    beginRow("Probe",
             "Light at the point under the cursor, as measure gives it, and its element. A click pins the "
             "point, Esc lets it go. Key: I");
    ImGui::Checkbox("under the cursor##probe", &settings.isProbing);
    if (settings.isProbing) {
        beginRow(
            "   links",
            "Lines to where the element's light comes from: wider ones carry more. Amber: elements, blue: "
            "clusters, white: lights and sky.");
        ImGui::Checkbox("lines##links", &settings.inspection.links);
        beginRow("   visibility", "The same lines, all alike, by how much of each is not blocked.");
        ImGui::Checkbox("colours##visibility", &settings.inspection.visibility);
        beginRow("   lit by", "What lights the point, as parts of its illuminance.");
        ImGui::Checkbox("list##contributors", &settings.inspection.contributors);
    }
}

}  // namespace

void drawShown(const PanelInfo& info, ViewSettings& settings, solve::Options& options) {
    using render::Shown;
    struct Kind {
        Shown shown;
        const char* name;
        bool needsSolver;
    };
    constexpr std::array<Kind, 7> kKinds{{{Shown::picture, "Picture", false},
                                          {Shown::illuminance, "Illuminance", false},
                                          {Shown::luminance, "Luminance", false},
                                          {Shown::level, "Level of elements", true},
                                          {Shown::residual, "Residual", true},
                                          {Shown::objects, "Objects", false},
                                          {Shown::linkErrors, "Error of links", true}}};
    render::DrawSettings& draw = settings.draw;
    beginRow("Show",
             "Picture: as a camera sees it.\nIlluminance: light that arrives, in lux. Key: C\nLuminance: "
             "brightness of the surfaces, in cd/m\u00b2.\nLevel of elements: how often they were "
             "quartered.\nResidual: what a further sweep would change.\nObjects: each in a colour of its "
             "own.\nError of links: what they leave "
             "in the light of each element.");
    if (ImGui::BeginCombo("##shown", kKinds[static_cast<std::size_t>(draw.shown)].name)) {
        for (const Kind& kind : kKinds) {
            const bool isOffered = info.session || !kind.needsSolver;
            if (isOffered && ImGui::Selectable(kind.name, kind.shown == draw.shown)) {
                draw.shown = kind.shown;
                draw.range.reset();
            }
        }
        ImGui::EndCombo();
    }
    if (draw.shown == Shown::illuminance || draw.shown == Shown::luminance) {
        drawValues(info, draw);
    }
    if (info.session) {
        drawLightOfDisplay(*info.session, options);
        drawOverlays(settings);
    }
}

}  // namespace fluxwalk::ui
