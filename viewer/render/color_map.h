#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"

namespace fluxwalk::render {

using Color8 = std::array<std::uint8_t, 3>;  ///< sRGB

/// Colours in perceptual order: from dark violet over blue and green to pale yellow, lightness rising evenly.
class ColorMap {
  public:
    static constexpr std::size_t kSize = 256;

    ColorMap();

    /// Colour at a place in [0, 1]; places beyond are clamped.
    const Color8& at(double place) const;
    const std::array<Color8, kSize>& colors() const { return colors_; }

  private:
    std::array<Color8, kSize> colors_;
};

/// Display colour (encoded sRGB in [0, 1]) of an OKLCh colour (Ottosson 2020; hue in degrees), its chroma
/// brought down to what a screen can show.
base::Vec3d colorOfLch(double lightness, double chroma, double hue);

/// A colour of its own for each number, neighbours far apart in hue.
base::Rgb colorOfNumber(std::uint32_t number);

}  // namespace fluxwalk::render
