#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/scene/sensor.h"
#include "core/solve/point_gather.h"
#include "core/solve/solver.h"

namespace fluxwalk::image {

/// A sensor this close to a surface along its normal, as a part of the scene's extent, sits on it.
inline constexpr double kCaptureReach = 1e-3;

/// The point of a lit side that a sensor sits on (kCaptureReach). Nothing for sensors in free space, and in
/// gaps that count as dark.
std::optional<solve::GatherPoint> findSurfacePoint(const solve::Problem& problem,
                                                   const scene::Sensor& sensor);

/// Whether a sensor lies within a solid, or somewhere else where no light comes: of rays into all directions
/// a quarter or more meet sides that light never reaches.
bool isInSolid(const rays::RayScene& rays, const hierarchy::ReachedSides& reached,
               const scene::Sensor& sensor);

/// Irradiance at sensors in lux per channel, in the order given, by point gather through the links of a
/// solution: a sensor within 1e-3 of the scene's extent along its normal sits on that surface, others are in
/// free space and get links of their own.
std::vector<base::Rgb> measure(const solve::Solver& solver, std::span<const scene::Sensor> sensors);

}  // namespace fluxwalk::image
