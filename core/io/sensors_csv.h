#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/sensor.h"

/// Sensors as text: a header, then one row for each (metres, y up).
namespace fluxwalk::io {

/// A column of numbers, one for each sensor, as the header names it.
struct SensorColumn {
    std::string name;
    std::vector<double> values;
};

struct SensorTable {
    std::vector<scene::Sensor> sensors;
    std::vector<SensorColumn> columns;

    /// Values of a column; nothing where there is none of that name.
    std::optional<std::span<const double>> find(std::string_view name) const;
};

/// Reads the columns x,y,z,nx,ny,nz (named so by the header, first and in this order; what follows them is
/// ignored). Normals are made unit. Throws base::FileError with the line where a row is short, not a number,
/// not finite, or has no normal.
std::vector<scene::Sensor> readSensors(const std::filesystem::path& file);

/// The same, and all that follows, which must be numbers too, as many as the header has names.
SensorTable readSensorTable(const std::filesystem::path& file);

/// Writes x,y,z,nx,ny,nz and the columns, in the order given, numbers with nine digits. Throws
/// base::FileError.
void writeSensorTable(const std::filesystem::path& file, const SensorTable& table);

/// The columns E_r,E_g,E_b and lux: irradiance per channel and its luminance.
std::vector<SensorColumn> irradianceColumns(std::span<const base::Vec3d> irradiance);

}  // namespace fluxwalk::io
