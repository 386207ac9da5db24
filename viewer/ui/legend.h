#pragma once

#include <string>
#include <vector>

#include "viewer/render/scene_renderer.h"

namespace fluxwalk::ui {

/// Where things are drawn over a picture.
struct Canvas {
    float scale = 1.0f;     ///< 1 at 96 dpi
    float reserved = 0.0f;  ///< height in pixels at the lower edge that is kept free
    float left = 0.0f;      ///< width in pixels at the left edge that is covered
};

/// What the colours of a picture mean.
struct Legend {
    struct Mark {
        double place = 0.0;  ///< 0 at the lower end, 1 at the upper
        std::string label;
        bool hasTick = true;
    };
    std::string title;
    /// From below; one colour for each step.
    std::vector<render::Color8> colors;
    std::vector<Mark> marks;
};

/// Round numbers beside the colour map, for values shown in a range; the title names quantity and unit.
Legend makeLegend(const render::DrawSettings& settings, const render::ValueRange& range,
                  const render::ColorMap& map);

/// For links coloured by the part of them that is not blocked.
Legend makeVisibilityLegend(const render::ColorMap& map);

/// Draws it in the lower right corner of the picture, so many pixels from the right edge. Labels that would
/// touch are left out. Returns the width that it takes.
float drawLegend(const Legend& legend, const Canvas& canvas, float fromRight = 0.0f);

}  // namespace fluxwalk::ui
