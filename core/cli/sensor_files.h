#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/image/intervals.h"
#include "core/reference/path_tracer.h"
#include "core/scene/sensor.h"

/// What sensors read, as tables and for people.
namespace fluxwalk::cli {

/// Whether a result goes into JSON, by its file's name; else CSV.
bool isJsonFile(const std::filesystem::path& file);

/// CSV: x,y,z,nx,ny,nz,E_r,E_g,E_b,lux,low,high,solid, the interval and the illuminance in lux, solid 1 where
/// the sensor lies in a solid. JSON: the same with words, the parts of the interval (standard deviations in
/// lux) and the statistics. Throws WriteError.
void writeMeasurements(const std::filesystem::path& file, std::span<const scene::Sensor> sensors,
                       std::span<const image::Measurement> measured, image::IntervalKind kind);

/// CSV: x,y,z,nx,ny,nz,E_r,E_g,E_b,lux,se_r,se_g,se_b,se_lux, standard errors in lux. JSON: the same with
/// words, paths and rays. Sensors without a standard error are left out. Throws WriteError.
void writeReference(const std::filesystem::path& file, std::span<const scene::Sensor> sensors,
                    std::span<const reference::Estimate> estimates,
                    const reference::IrradianceTracer& tracer);

/// "40 sensors: mean 312 lx, least 102 lx, most 498 lx, U0 0.33; interval 4.1 % wide (median)".
std::string describeMeasurements(std::span<const image::Measurement> measured, image::IntervalKind kind);

}  // namespace fluxwalk::cli
