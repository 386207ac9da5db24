#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/sensor.h"

/// The true irradiance at the benchmark sensors, from the path tracer, as a table beside the benchmarks.
namespace fluxwalk::bench {

using base::Vec3d;

struct ReferencePoint {
    scene::Sensor sensor;
    Vec3d irradiance{0.0};     ///< lux, each channel
    Vec3d standardError{0.0};  ///< of that, lux
};

struct Reference {
    std::vector<ReferencePoint> points;
    std::size_t hiddenCount = 0;  ///< drawn, and left out because they lie under solids
};

/// Mean of E* over sensors and channels, lux.
double meanIrradiance(std::span<const ReferencePoint> points);
/// Mean square of the standard errors over sensors and channels, lux2.
double noiseSquare(std::span<const ReferencePoint> points);

/// Draws the benchmark sensors over the sides that light reaches and traces `paths` from each.
Reference traceReference(const scene::Scene& scene, std::uint64_t paths, unsigned threads);

/// Sensors that share some objects.
struct SensorGroup {
    std::vector<std::uint32_t> objects;
    std::size_t count = 0;
};
/// The same with a part of the sensors for each group.
Reference traceReference(const scene::Scene& scene, std::uint64_t paths, unsigned threads,
                         std::span<const SensorGroup> groups);

/// Rows x,y,z,nx,ny,nz,E_r,E_g,E_b,se_r,se_g,se_b below a header. Both throw base::FileError.
void writeReference(const std::filesystem::path& file, const Reference& reference);
/// Points that are missing from the number of benchmark sensors count as hidden.
Reference readReference(const std::filesystem::path& file);

}  // namespace fluxwalk::bench
