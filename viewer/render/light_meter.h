#pragma once

#include <span>

#include "viewer/gl/pixel_size.h"
#include "viewer/render/exposure.h"

namespace fluxwalk::render {

/// Size of the picture that is metered, for a view `aspect` times as wide as high: some thousand pixels.
gl::PixelSize meterSize(double aspect);

/// Exposure per cd/m2 for what is seen: of Output::meter, three floats a pixel. The middle of the picture
/// counts most, see automaticExposure(). Lamps do not count unless nothing else is lit. 1 where nothing
/// shines.
double meterExposure(std::span<const float> pixels, gl::PixelSize size);

}  // namespace fluxwalk::render
