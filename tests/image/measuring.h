#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "core/image/sensors.h"
#include "core/reference/path_tracer.h"
#include "core/solve/state.h"

/// Solves a scene and compares what sensors read with the path tracer.
namespace fluxwalk::test {

inline std::unique_ptr<solve::Solver> solveScene(scene::Scene scene, double error) {
    solve::Options options;
    options.error = error;
    options.errorOf = solve::ErrorOf::gathered;
    auto solver =
        std::make_unique<solve::Solver>(std::make_shared<const scene::Scene>(std::move(scene)), options, 2);
    solver->solve({});
    return solver;
}

struct Comparison {
    double error = 0.0;          ///< RMS over sensors and channels, relative to the mean
    double standardError = 0.0;  ///< of the reference, likewise
    double bias = 0.0;           ///< of the mean, relative
    double mean = 0.0;           ///< lux
};

inline Comparison compare(const solve::Solver& solver, const std::vector<scene::Sensor>& sensors,
                          std::uint64_t paths) {
    const solve::Problem& problem = solver.problem();
    const std::vector<base::Rgb> measured = image::measure(solver, sensors);
    const reference::PathResult traced =
        reference::traceIrradiance(*problem.scene, problem.rays, problem.executor, sensors, {7, paths});
    Comparison result;
    const double n = 3.0 * static_cast<double>(sensors.size());
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const reference::Estimate& e = traced.irradiance[i];
        const base::Vec3d d = base::Vec3d(measured[i]) - e.mean;
        result.error += glm::dot(d, d) / n;
        result.standardError += glm::dot(e.standardError, e.standardError) / n;
        result.bias += (d.x + d.y + d.z) / n;
        result.mean += (e.mean.x + e.mean.y + e.mean.z) / n;
    }
    result.error = std::sqrt(result.error) / result.mean;
    result.standardError = std::sqrt(result.standardError) / result.mean;
    result.bias /= result.mean;
    return result;
}

/// Expects that sensors agree within the requested error and the reference's own.
inline void expectAgreement(const Comparison& comparison, double error) {
    EXPECT_GT(comparison.mean, 0.0);
    // So that a wrong solution could be told.
    EXPECT_LE(comparison.standardError, .75 * error);
    EXPECT_LE(comparison.error, std::hypot(error, comparison.standardError));
    EXPECT_LE(std::abs(comparison.bias), .5 * error);
}

}  // namespace fluxwalk::test
