#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/rays/ray_scene.h"
#include "core/reference/estimate.h"
#include "core/reference/shaded_scene.h"
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

/// How far the two halves of the paths of a run differ, measured with their own standard errors: 1 where
/// those say what they should. Sensors without any spread do not count.
struct NoiseCheck {
    double ratio = 1.0;      ///< mean of (difference / its standard error) squared
    double deviation = 0.0;  ///< of that mean, if the standard errors are right
    std::size_t count = 0;   ///< sensors
};

/// The same in parts: paths can be added until time or precision is reached.
class IrradianceTracer {
  public:
    /// Paths are added in groups of this many; a group is finished once begun.
    static constexpr std::uint64_t kGroup = 64;

    /// Keeps references to all but the sensors.
    IrradianceTracer(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
                     std::span<const scene::Sensor> sensors, std::uint64_t seed);

    /// `paths` more for each sensor; all but the last call want a multiple of kGroup. `shouldStop` is asked
    /// before each group, from any thread; what is done by then counts, so that sensors may have unequal
    /// numbers of paths. After such a stop no more can be added.
    void add(std::uint64_t paths, const std::function<bool()>& shouldStop = {});

    /// What a sensor has by now depends on the seed and the number of its paths alone.
    std::vector<Estimate> irradiance() const;
    NoiseCheck checkNoise() const;
    /// Paths of each sensor that was not stopped.
    std::uint64_t paths() const { return paths_; }
    std::uint64_t rays() const { return rays_; }
    std::size_t sensorCount() const { return sensors_.size(); }

  private:
    /// Of the paths with even and with odd numbers.
    using Halves = std::array<SampleSums, 2>;

    ShadedScene shaded_;
    const base::Executor& executor_;
    std::vector<scene::Sensor> sensors_;
    std::uint64_t seed_;
    std::vector<Halves> sums_;
    std::uint64_t paths_ = 0;
    std::uint64_t rays_ = 0;
};

}  // namespace fluxwalk::reference
