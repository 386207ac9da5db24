#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/hierarchy/reach.h"
#include "core/image/intervals.h"

/// Sensors in regular order, for what regulations ask: mean, least and uniformity over a surface or a working
/// plane.
namespace fluxwalk::image {

/// Sensors that one grid may have at most.
inline constexpr std::size_t kMostGridSensors = 1'000'000;

struct Grid {
    std::vector<scene::Sensor> sensors;
    double spacing = 0.0;  ///< metres
    /// Of a plane: cells along x and z; the sensors are in their middles, row by row, x first. 0 over
    /// objects.
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    base::Vec2d origin{0.0};  ///< x and z of the first cell's corner, metres
};

/// Upward sensors over the scene's extent at a height (y, metres), in square cells of `spacing`. Throws
/// base::UsageError where there would be more than kMostGridSensors, or the plane misses the scene.
Grid makePlaneGrid(const scene::Scene& scene, double height, double spacing);

/// Sensors over the sides of an object that light reaches, one for each spacing x spacing: in rows on patches
/// that are larger, and on every so-manieth of smaller ones. Throws base::UsageError where there would be
/// more than kMostGridSensors, or light reaches no side.
Grid makeObjectGrid(const scene::Scene& scene, const hierarchy::ReachedSides& reached, std::uint32_t object,
                    double spacing);

/// Illuminance over sensors in lux; those inside solids do not count.
struct IlluminanceStatistics {
    std::size_t count = 0;
    std::size_t inSolids = 0;
    double mean = 0.0;
    double minimum = 0.0;
    double maximum = 0.0;
    double uniformity = 0.0;  ///< U0: minimum by mean; 0 in the dark
};
IlluminanceStatistics summarize(std::span<const Measurement> measured);

}  // namespace fluxwalk::image
