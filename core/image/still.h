#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace fluxwalk::image {

/// A picture with what it is made of, rows from the top. 40 bytes a pixel: 1.3 GB at 7680 x 4320.
struct Still {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> luminance;   ///< linear light, cd/m2, three a pixel
    std::vector<float> irradiance;  ///< lux, three a pixel
    /// Bits of 16-bit floats, three a pixel: reflectance, and unit normal towards the eye (as shaded).
    std::vector<std::uint16_t> albedo;
    std::vector<std::uint16_t> normal;
    /// Index of the object in the middle of the pixel, from 1; 0 for none.
    std::vector<std::uint32_t> object;
    std::uint64_t rays = 0;     ///< shadow rays
    std::uint64_t gathers = 0;  ///< points at which light was gathered
    /// Rows from the top that are complete; fewer than `height` where the making was stopped.
    std::uint32_t rowsDone = 0;
};

/// Stills are made in tiles, whose left and top are multiples of this many pixels.
inline constexpr std::uint32_t kTile = 32;

/// Part of a still, in pixels from its upper left corner.
struct StillTile {
    std::uint32_t left = 0;
    std::uint32_t top = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

}  // namespace fluxwalk::image
