#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/scene/sensor.h"
#include "core/solve/point_gather.h"
#include "core/solve/solver.h"

namespace fluxwalk::image {

/// The point of a lit side that a sensor sits on: within 1e-3 of the scene's extent along its normal. Nothing
/// for sensors in free space.
std::optional<solve::GatherPoint> findSurfacePoint(const solve::Problem& problem,
                                                   const scene::Sensor& sensor);

/// Irradiance at sensors in lux per channel, in the order given, by point gather through the links of a
/// solution: a sensor within 1e-3 of the scene's extent along its normal sits on that surface, others are in
/// free space and get links of their own.
std::vector<base::Rgb> measure(const solve::Solver& solver, std::span<const scene::Sensor> sensors);

}  // namespace fluxwalk::image
