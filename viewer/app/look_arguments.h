#pragma once

#include "viewer/render/scene_renderer.h"
#include "viewer/ui/inspection.h"

namespace CLI {
class App;
}

namespace fluxwalk::app {

struct LookArguments {
    render::DrawSettings draw;
    ui::InspectionView inspection;
    int samples = 8;                  ///< a pixel, of a written picture
    std::optional<base::Vec2d> pick;  ///< pixel of the picture, from its upper left corner
};

/// Adds the options that say what a picture, or the window at first, shows of the surfaces. They throw
/// base::UsageError for what they cannot read.
void addLookOptions(CLI::App& app, LookArguments& look);

/// Adds the options that say how light becomes a picture: exposure, tone curve.
void addToneOptions(CLI::App& app, LookArguments& look);
/// The same, and those for what the GPU draws: samples, glow.
void addPictureOptions(CLI::App& app, LookArguments& look);

/// A range as typed: two numbers, "A:B" with 0 <= A < B. Throws base::UsageError.
render::ValueRange parseRange(const std::string& text);

/// Throws base::UsageError where options of a look contradict each other.
void checkLook(const LookArguments& look);

}  // namespace fluxwalk::app
