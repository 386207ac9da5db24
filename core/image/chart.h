#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/image/grid.h"

/// Values as coloured pictures with a legend.
namespace fluxwalk::image {

/// 8-bit sRGB pixels, three bytes each, rows from the top.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> pixels;
};

using Color = std::array<std::uint8_t, 3>;

/// From dark violet to yellow (viridis; van der Walt and Smith 2015) for a place in [0, 1].
Color colorOfValue(double place);
/// From blue by white to red for a place in [-1, 1].
Color colorOfDifference(double place);

/// A grid over a plane seen from above, x to the right and z downwards, with a legend in lux from 0 to a
/// round number; grey where sensors are inside solids.
Picture drawPlan(const Grid& grid, std::span<const Measurement> measured);

/// Signed relative differences, one a pixel, with a legend in per cent. Grey where they are not finite
/// (nothing is seen there). `range`: the difference that has the last colour.
Picture drawDifference(std::uint32_t width, std::uint32_t height, std::span<const double> differences,
                       double range);

/// Mean of the finite values around each finite one, weighed by a Gaussian of `deviation` pixels: what stays
/// of differences when their noise is averaged away. 0 leaves all as it is.
std::vector<double> blurKnown(std::uint32_t width, std::uint32_t height, std::span<const double> values,
                              double deviation);

/// A round range that 98 of 100 differences lie in.
double chooseDifferenceRange(std::span<const double> differences);

/// The next of 1, 2 and 5 times a power of ten that is not below a positive value.
double roundUp(double value);

}  // namespace fluxwalk::image
