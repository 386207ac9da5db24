#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/rays/ray_scene.h"
#include "core/reference/estimate.h"
#include "core/scene/scene.h"

/// Audit of fluxes by particles that leave the emitters: independent of the solver and of the path tracer's
/// estimator.
namespace fluxwalk::reference {

struct PhotonOptions {
    std::uint64_t seed = 1;
    std::uint64_t particles = 1'000'000;
};

struct PhotonResult {
    /// Mean irradiance in lux: [object][0 front, 1 back].
    std::vector<std::array<Estimate, 2>> objectIrradiance;
    /// Mean irradiance in lux: [object][patch][0 front, 1 back].
    std::vector<std::vector<std::array<Estimate, 2>>> patchIrradiance;
    /// Flux in lm that left the emitters. Of directional lights and the sky: what enters the sphere about the
    /// scene's bounds.
    Estimate emitted;
    Estimate absorbed;
    Estimate escaped;
    std::uint64_t rays = 0;
};

/// Follows particles from emissive patches, lights and the sky until they are absorbed or leave the scene.
/// Ranges of lights are ignored: a light that ends is no flux. Standard errors come from 64 independent
/// batches.
PhotonResult tracePhotons(const scene::Scene& scene, const rays::RayScene& rays,
                          const base::Executor& executor, const PhotonOptions& options);

}  // namespace fluxwalk::reference
