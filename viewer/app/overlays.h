#pragma once

#include <optional>

#include "core/solve/solver.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/ui/legend.h"

namespace fluxwalk::app {

/// What snapshots must tell for what is to be shown.
solve::Detail detailFor(const render::DrawSettings& look);

/// Puts what the look shows of a snapshot into the overlay: faces, edges of elements, boxes of clusters.
/// Returns what the colours of the faces mean; nothing where they are only names, or there are none.
std::optional<ui::Legend> fillOverlay(render::Overlay& overlay, const solve::Snapshot& snapshot,
                                      const render::DrawSettings& look, const render::ColorMap& map);

/// Legends of what is shown, side by side: of the faces' colours or of the light, and of the probe's
/// visibility.
void drawLegends(const ui::Canvas& canvas, const render::DrawSettings& look,
                 const std::optional<ui::Legend>& faces, bool hasVisibility, const render::ValueRange& range,
                 const render::ColorMap& map);

}  // namespace fluxwalk::app
