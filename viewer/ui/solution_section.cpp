#include <imgui.h>

#include "viewer/ui/option_widget.h"
#include "viewer/ui/panel.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {

bool drawSolution(const PanelInfo& info, solve::Options& options) {
    const double threshold = info.snapshot != nullptr ? info.snapshot->statistics.threshold : 0.0;
    bool isChanged = drawOption("error", "Error target", options);
    isChanged |= drawOption("oracle", "Oracle", options);
    isChanged |= drawOption("threshold", "Threshold", options, threshold);
    if (!ImGui::TreeNodeEx("More##solution", ImGuiTreeNodeFlags_SpanAvailWidth)) {
        return isChanged;
    }
    // Rows stay aligned with those above.
    ImGui::Unindent(ImGui::GetTreeNodeToLabelSpacing());
    isChanged |= drawOption("curvature-weight", "Curvature", options);
    isChanged |= drawOption("min-area", "Least element", options, 1e-3);
    isChanged |= drawOption("cluster-links", "Cluster links", options);
    isChanged |= drawOption("cluster-model", "Clusters are", options);
    isChanged |= drawOption("clusters", "Built by", options);
    isChanged |= drawOption("visibility-rays", "Rays a pair", options);
    isChanged |= drawOption("rays", "Rays", options);
    isChanged |= drawOption("pull", "Pull", options);
    isChanged |= drawOption("row-scaling", "Row scaling", options);
    ImGui::Indent(ImGui::GetTreeNodeToLabelSpacing());
    ImGui::TreePop();
    return isChanged;
}

}  // namespace fluxwalk::ui
