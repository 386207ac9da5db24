#include "viewer/app/still_file.h"

#include <array>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "core/base/photometry.h"
#include "core/io/exr_layers.h"
#include "core/io/image_write.h"
#include "viewer/app/picture_file.h"
#include "viewer/render/light_meter.h"

namespace fluxwalk::app {
namespace {

/// What is left of a pixel's light without its reflected part counts as emitted above this part of it.
constexpr float kEmitted = 1e-3f;

float fraction(float v) {
    return v - std::floor(v);
}

// As in shaders/tone.glsl.
float ditherNoise(float x, float y) {
    return fraction(52.9829189f * fraction(x * 0.06711056f + y * 0.00583715f)) - 0.5f;
}

base::Rgb colorAt(const std::vector<float>& values, std::size_t pixel) {
    return {values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]};
}

base::Rgb halvesAt(const std::vector<std::uint16_t>& values, std::size_t pixel) {
    return {glm::unpackHalf1x16(values[3 * pixel]), glm::unpackHalf1x16(values[3 * pixel + 1]),
            glm::unpackHalf1x16(values[3 * pixel + 2])};
}

}  // namespace

double meterStill(const image::Still& still) {
    const std::size_t pixels = std::size_t{still.width} * still.height;
    std::vector<float> metered(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float all = base::luminance(colorAt(still.luminance, i));
        const float reflected = base::luminance(halvesAt(still.albedo, i) * colorAt(still.irradiance, i)) *
                                static_cast<float>(1.0 / base::kPi);
        // What lies behind the scene is no surface, and does not count.
        if (still.object[i] != 0) {
            metered[3 * i + (all - reflected > kEmitted * all + 1e-3f * reflected ? 1 : 0)] = all;
        }
    }
    return render::meterExposure(metered, {static_cast<int>(still.width), static_cast<int>(still.height)});
}

std::vector<std::uint8_t> developStill(const image::Still& still, double exposure, render::ToneCurve curve) {
    const std::size_t pixels = std::size_t{still.width} * still.height;
    std::vector<std::uint8_t> rgb(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const base::Rgb shown =
            render::applyToneCurve(static_cast<float>(exposure) * colorAt(still.luminance, i), curve);
        // OpenGL counts rows from below.
        const std::size_t row = i / still.width;
        const float noise = ditherNoise(static_cast<float>(i % still.width) + 0.5f,
                                        static_cast<float>(still.height - 1 - row) + 0.5f);
        for (int c = 0; c < 3; ++c) {
            const float value = 255.0f * render::encodeSrgb(shown[c]) + noise;
            rgb[3 * i + static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(std::lround(std::fmin(255.0f, std::fmax(0.0f, value))));
        }
    }
    return rgb;
}

void writeStillLight(const std::filesystem::path& file, const image::Still& still, bool asHalf) {
    const std::array<io::ExrLayer, 5> layers{{
        {{"R", "G", "B"}, std::span<const float>(still.luminance), asHalf},
        {{"irradiance.R", "irradiance.G", "irradiance.B"}, std::span<const float>(still.irradiance), asHalf},
        {{"albedo.R", "albedo.G", "albedo.B"}, std::span<const std::uint16_t>(still.albedo), false},
        {{"normal.X", "normal.Y", "normal.Z"}, std::span<const std::uint16_t>(still.normal), false},
        {{"object.id"}, std::span<const std::uint32_t>(still.object), false},
    }};
    io::writeExrLayers(file, still.width, still.height, layers);
}

void writeStill(const std::filesystem::path& file, const image::Still& still, double exposure,
                render::ToneCurve curve, bool asHalf) {
    if (isLightFile(file)) {
        writeStillLight(file, still, asHalf);
    } else {
        io::writePng(file, still.width, still.height, developStill(still, exposure, curve));
    }
}

}  // namespace fluxwalk::app
