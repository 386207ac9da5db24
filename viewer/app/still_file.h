#pragma once

#include <filesystem>

#include "core/image/still.h"
#include "viewer/render/tone.h"

/// Stills as files: *.exr holds the light and what it is made of, all others are PNG.
namespace fluxwalk::app {

/// Exposure per cd/m2 as the viewer's light meter finds it for the same picture.
double meterStill(const image::Still& still);

/// Pixels of a still as the viewer shows them: exposed, through a tone curve, sRGB, dithered.
std::vector<std::uint8_t> developStill(const image::Still& still, double exposure, render::ToneCurve curve);

/// Channels R, G, B (luminance in cd/m2), irradiance.R, G, B (lux), albedo.R, G, B, normal.X, Y, Z and
/// object.id. Light as 16-bit floats with `asHalf`, which end at 65,504; albedo and normal always. Throws
/// base::FileError.
void writeStillLight(const std::filesystem::path& file, const image::Still& still, bool asHalf);

/// One of both, by the file's name. Throws base::FileError.
void writeStill(const std::filesystem::path& file, const image::Still& still, double exposure,
                render::ToneCurve curve, bool asHalf);

}  // namespace fluxwalk::app
