#pragma once

#include <vector>

#include "core/solve/solver.h"
#include "core/solve/state.h"
#include "tests/bench/reference_values.h"

/// The error of a solution at the benchmark sensors, read in the three ways in which it can be read.
namespace fluxwalk::bench {

using base::Rgb;

/// All as parts of 1. `rms` is the error p of the design, section 1, without the reference's own noise (which
/// adds to the squares); `p95` is the 95th percentile of |E - E*| / E* over channels where E* > 0.1 mean and
/// holds that noise; `bias` is the mean of E - E* by the mean of E*.
struct ErrorFigures {
    double rms = 0.0;
    double p95 = 0.0;
    double bias = 0.0;
};

/// What the reference's noise alone would give.
struct NoiseFigures {
    double rms = 0.0;   ///< part of the mean; RMS is already free of it
    double p95 = 0.0;   ///< of the local relative error, which is not
    double bias = 0.0;  ///< standard error of the bias, channels taken as fully correlated
};
NoiseFigures noiseOf(const std::vector<ReferencePoint>& reference);

ErrorFigures compare(const std::vector<Rgb>& values, const std::vector<ReferencePoint>& reference);

/// Where a sensor lies on its object.
struct Site {
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
    bool back = false;
    base::Vec2d uv{};
};

/// Sites of a reference's points. Throws base::FileError where a point lies on no surface of the scene.
std::vector<Site> findSites(const scene::Scene& scene, const rays::RayScene& rays,
                            const std::vector<ReferencePoint>& reference);

/// Reads solutions of one scene at its benchmark sensors.
class SensorErrors {
  public:
    /// Throws base::FileError where a point of the reference lies on no surface of the scene.
    SensorErrors(const solve::Problem& problem, const std::vector<ReferencePoint>& reference);

    /// The constant of the leaf that holds the sensor.
    ErrorFigures ofLeaves(const solve::Problem& problem) const;
    /// The interpolated vertex values of lit meshes.
    ErrorFigures ofMeshes(const scene::LitMeshes& meshes, const base::Executor& executor) const;
    /// Gathered at the sensor through the links.
    ErrorFigures ofGathered(const solve::Solver& solver) const;

  private:
    const std::vector<ReferencePoint>& reference_;
    std::vector<Site> sites_;
    double tolerance_ = 0.0;
};

}  // namespace fluxwalk::bench
