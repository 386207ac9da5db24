#pragma once

#include <cmath>

#include "core/base/vec.h"

/// Units: exitance and emission in lm/m2, irradiance in lux, luminance L = B / pi in cd/m2, flux in lm.
namespace fluxwalk::base {

inline constexpr double kPi = 3.14159265358979323846;

/// Photometric value of a colour: Y = .2126 R + .7152 G + .0722 B.
inline float luminance(const Rgb& c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

inline double luminance(const Vec3d& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// Linear light of an sRGB value in [0, 1] (IEC 61966-2-1).
inline double linearFromSrgb(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Mean of the three channels: the scalar in which oracles weigh errors (DESIGN: RMS over channels).
inline float channelMean(const Rgb& c) {
    return (c.r + c.g + c.b) * (1.0f / 3.0f);
}

}  // namespace fluxwalk::base
