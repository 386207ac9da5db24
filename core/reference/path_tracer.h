#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/rays/ray_scene.h"
#include "core/reference/estimate.h"
#include "core/scene/scene.h"
#include "core/scene/sensor.h"

/// Monte-Carlo irradiance: an oracle for tests and `verify` that shares no sampling and no visibility code
/// with the solver.
namespace fluxwalk::reference {

struct PathOptions {
    std::uint64_t seed = 1;
    /// Independent paths for each sensor; at least 2.
    std::uint64_t paths = 1024;
};

struct PathResult {
    /// Irradiance in lux for each sensor, in their order.
    std::vector<Estimate> irradiance;
    std::uint64_t rays = 0;
};

/// Irradiance at sensors by path tracing: emissive patches are drawn by power and met by cosine-distributed
/// rays, weighted by the balance heuristic (Veach and Guibas 1995); lights without area are added at every
/// vertex; the sky is met by the rays that leave. A light reaches no farther than its range. The result
/// depends on the seed alone, not on the number of threads.
PathResult traceIrradiance(const scene::Scene& scene, const rays::RayScene& rays,
                           const base::Executor& executor, std::span<const scene::Sensor> sensors,
                           const PathOptions& options);

}  // namespace fluxwalk::reference
