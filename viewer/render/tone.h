#pragma once

#include <cstdint>

#include "core/base/vec.h"

/// From luminance to the screen. shaders/tone.glsl is the same for the GPU; a test compares them.
namespace fluxwalk::render {

/// How exposed luminance becomes a display value; the numbers are those of the shader.
enum class ToneCurve : std::uint8_t { linear = 0, filmic = 1, reinhard = 2, hue = 3 };

/// Applies the curve to exposed luminance (1 is white for the linear curve). Display-linear, may exceed 1.
base::Rgb applyToneCurve(const base::Rgb& exposed, ToneCurve curve);

/// sRGB transfer function (IEC 61966-2-1) of a display-linear value, clamped to [0, 1].
float encodeSrgb(float value);
/// Its inverse, for one byte of a picture.
float decodeSrgb(std::uint8_t byte);

}  // namespace fluxwalk::render
