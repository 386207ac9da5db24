#pragma once

#include <cstdint>
#include <vector>

#include "viewer/render/exposure.h"

/// Quantities shown as colours. shaders/false_color.glsl is the same for the GPU; a test compares them.
namespace fluxwalk::render {

enum class ValueScale : std::uint8_t { logarithmic = 0, linear = 1 };

/// From the value that has the first colour to that which has the last; a logarithmic range starts above 0.
struct ValueRange {
    double least = 0.0;
    double most = 0.0;

    bool operator==(const ValueRange&) const = default;
};

/// Place of a value on a range, 0 at its least and 1 at its most, clamped.
double placeOf(double value, const ValueRange& range, ValueScale scale);

/// A range with round ends for a distribution: all but the darkest fiftieth and the brightest hundredth of
/// the area, from 0 if linear, between one and four decades if logarithmic. 0.1 to 1000 where nothing is lit.
ValueRange chooseRange(const LuminanceHistogram& values, ValueScale scale);

/// Distance of the round numbers on a linear range, 1, 2 or 5 times a power of ten.
double roundStep(const ValueRange& range);

/// The round numbers within a range: multiples of roundStep(), or 1, 2 and 5 times the powers of ten.
std::vector<double> roundNumbers(const ValueRange& range, ValueScale scale);

}  // namespace fluxwalk::render
