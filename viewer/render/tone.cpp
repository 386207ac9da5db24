#include "viewer/render/tone.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::render {
namespace {

/// Rational curve through (0, 0) with slope 0.6, (0.18, 0.18), (1, 0.782) and (8, 0.99), tending to 1.
float filmic(float x) {
    return x * (3.68f * x + 0.6f) / (x * (3.68f * x + 0.79f) + 1.0f);
}

}  // namespace

base::Rgb applyToneCurve(const base::Rgb& exposed, ToneCurve curve) {
    switch (curve) {
        case ToneCurve::filmic:
            return {filmic(exposed.r), filmic(exposed.g), filmic(exposed.b)};
        case ToneCurve::reinhard: {
            // Reinhard et al. 2002, eq. 4, on luminance: keeps the hue; four times white becomes white.
            const float y = base::luminance(exposed);
            return exposed * ((1.0f + y / 16.0f) / (1.0f + y));
        }
        case ToneCurve::hue: {
            const float peak = std::max({exposed.r, exposed.g, exposed.b, 1e-12f});
            const float curved = filmic(peak);
            const float square = curved * curved;
            const float white = square * square * square * square;
            return curved * glm::mix(exposed / peak, base::Rgb(1.0f), white);
        }
        case ToneCurve::linear:
            break;
    }
    return exposed;
}

float encodeSrgb(float value) {
    const float x = std::clamp(value, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float decodeSrgb(std::uint8_t byte) {
    const float x = static_cast<float>(byte) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

}  // namespace fluxwalk::render
