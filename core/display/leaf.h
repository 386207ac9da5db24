#pragma once

#include <cstdint>

#include "core/base/vec.h"
#include "core/surface/region.h"

namespace fluxwalk::display {

/// One leaf element of an object with its mean irradiance.
struct Leaf {
    std::uint32_t patch = 0;
    bool back = false;
    surface::Path path = surface::kRootPath;
    base::Rgb irradiance{0.0f};  ///< lux, each channel
    /// Part of its area outside other solids; values count in proportion, those of 0 not at all.
    float exposed = 1.0f;
};

}  // namespace fluxwalk::display
