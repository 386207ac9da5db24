#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/scene/sensor.h"

/// Sensors as text: a header, then one row for each (metres, y up).
namespace fluxwalk::io {

/// Reads the columns x,y,z,nx,ny,nz (named so by the header, first and in this order; what follows them is
/// ignored). Normals are made unit. Throws base::FileError with the line where a row is short, not a number,
/// not finite, or has no normal.
std::vector<scene::Sensor> readSensors(const std::filesystem::path& file);

/// Writes x,y,z,nx,ny,nz,E_r,E_g,E_b,lux in the order given: irradiance per channel and its luminance, lux.
/// Throws base::FileError.
void writeSensors(const std::filesystem::path& file, std::span<const scene::Sensor> sensors,
                  std::span<const base::Rgb> irradiance);

}  // namespace fluxwalk::io
