#pragma once

#include <string>

#include "core/image/final_gather.h"
#include "viewer/gl/pixel_size.h"
#include "viewer/ui/legend.h"

/// Stills in the window: what is chosen, what is told, what was clicked.
namespace fluxwalk::ui {

struct StillSettings {
    /// Pixels; zero for as many as the window has.
    gl::PixelSize size{0, 0};
    /// All but the size and the seed.
    image::StillOptions options;
    /// Exposed by itself once it is done, as `render` does, rather than as the window.
    bool hasOwnExposure = false;
};

/// The still that is there.
struct StillInfo {
    bool isThere = false;
    bool isAtWork = false;   ///< the solver stands still for it
    bool isOver = false;     ///< nothing is at work on it any more
    bool canBeKept = false;  ///< it is over with something done, and nothing is being written
    bool isLarge = false;    ///< over the picture, else in a corner
    double progress = 0.0;   ///< in [0, 1]
    std::string told;        ///< how far it is
    gl::PixelSize size;
};

struct StillActions {
    bool takes = false;
    bool cancels = false;
    bool closes = false;
    bool resizes = false;  ///< large, or back to the corner
    bool keepsPicture = false;
    bool keepsLight = false;

    void add(const StillActions& other);
};

/// Section of the panel. `estimatedError` of the solution, negative where it is not known.
StillActions drawStillSettings(const StillInfo& info, StillSettings& settings, double estimatedError);

/// Where a still of `size` is shown, in pixels from the upper left of the window.
struct StillPlace {
    float left = 0.0f;
    float top = 0.0f;
    float width = 0.0f;
    float height = 0.0f;
};
/// As large as the window allows, in its middle.
StillPlace placeLarge(gl::PixelSize size);
/// Of the size that it has in the corner; its place is the frame's.
StillPlace placeSmall(gl::PixelSize size, float scale);

/// Draws the still and its frame: large over the picture, with a bar above the line of keys, or small in a
/// window of its own. `texture` has its rows from below and the proportions of the place.
StillActions drawStill(const StillInfo& info, void* texture, const Canvas& canvas);

}  // namespace fluxwalk::ui
