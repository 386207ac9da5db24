#pragma once

#include <optional>
#include <string>

#include "core/solve/solver.h"
#include "viewer/render/scene_renderer.h"
#include "viewer/session/solver_session.h"
#include "viewer/ui/exposure_control.h"
#include "viewer/ui/inspection.h"
#include "viewer/ui/light_control.h"
#include "viewer/ui/places.h"
#include "viewer/ui/still.h"
#include "viewer/ui/walker.h"

namespace fluxwalk::ui {

/// What the user sets for the view.
struct ViewSettings {
    ExposureControl exposure;
    /// All but the exposure.
    render::DrawSettings draw;
    /// Values of the point under the cursor, or of a pinned one.
    bool isProbing = false;
    InspectionView inspection;
    bool smoothEdges = true;
    bool isPanelOpen = true;
    /// One for each of PanelInfo::lights.
    std::vector<LightControl> lights;
    StillSettings still;
};

/// What the panel tells.
struct PanelInfo {
    const scene::Scene* scene = nullptr;
    /// Newest solution; null before the first.
    const solve::Snapshot* snapshot = nullptr;
    /// Empty where nothing is solved (a lit file).
    std::optional<session::Status> session;
    bool isPaused = false;
    std::size_t triangleCount = 0;
    double framesPerSecond = 0.0;  ///< 0 while the picture stands still
    std::string renderer;
    /// What shines in the scene.
    std::vector<scene::LightSource> lights;
    /// Range in which values are shown at present.
    render::ValueRange shownRange;
    Places places;
    StillInfo still;
};

/// What the user did in one frame, beside changing the structures passed in.
struct PanelActions {
    bool changedOptions = false;
    bool togglesPause = false;
    bool steps = false;
    PlaceActions places;
    StillActions still;
};

/// Draws the panel at the left edge of the window. `scale` is 1 at 96 dpi.
PanelActions drawPanel(const PanelInfo& info, ViewSettings& settings, solve::Options& options, Walker& walker,
                       float scale);

/// Where the panel ends that drawPanel() draws first, in pixels from the left edge; 0 where it is hidden.
float rightOfPanel(const ViewSettings& settings, float scale);

/// Sections of the panel, each in its own file.
void drawShown(const PanelInfo& info, ViewSettings& settings, solve::Options& options);
void drawStatistics(const PanelInfo& info);
/// These return whether `options` changed.
bool drawPictureSettings(const PanelInfo& info, ViewSettings& settings, solve::Options& options);
bool drawLights(const PanelInfo& info, std::vector<LightControl>& controls, solve::Options& options);
bool drawSolution(const PanelInfo& info, solve::Options& options);
void drawConvergence(const solve::Statistics& statistics, double target, float scale);

}  // namespace fluxwalk::ui
