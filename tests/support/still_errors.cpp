#include "tests/support/still_errors.h"

#include <cmath>

#include "core/base/photometry.h"
#include "core/image/sight.h"
#include "core/reference/path_tracer.h"

namespace fluxwalk::test {

StillPoints findStillPoints(const solve::Problem& problem, const scene::Camera& camera,
                            const image::StillOptions& options, std::uint32_t step) {
    const image::Lens lens(camera, options.width, options.height);
    StillPoints points;
    for (std::uint32_t y = step / 2; y < options.height; y += step) {
        for (std::uint32_t x = step / 2; x < options.width; x += step) {
            const auto seen = image::lookAlong(problem, lens.eye(), lens.directionAt({x + 0.5, y + 0.5}));
            if (seen && seen->leaf != base::NodeId::none) {
                points.pixels.push_back(std::size_t{y} * options.width + x);
                points.sensors.push_back({seen->point.position, seen->point.shading});
                points.reflectance.push_back(seen->reflectance);
            }
        }
    }
    return points;
}

StillErrors compareStill(const solve::Problem& problem, const image::Still& still, const StillPoints& points,
                         std::uint64_t paths) {
    const reference::PathResult traced = reference::traceIrradiance(
        *problem.scene, problem.rays, problem.executor, points.sensors, {11, paths});
    StillErrors result;
    const double n = 3.0 * static_cast<double>(points.sensors.size());
    double squares = 0.0;
    double noise = 0.0;
    for (std::size_t i = 0; i < points.sensors.size(); ++i) {
        const std::size_t pixel = 3 * points.pixels[i];
        result.differences.push_back(0.0);
        result.truths.push_back(0.0);
        for (int c = 0; c < 3; ++c) {
            const double reflectance = static_cast<double>(points.reflectance[i][c]) / base::kPi;
            const double shown =
                reflectance * static_cast<double>(still.irradiance[pixel + static_cast<std::size_t>(c)]);
            const double truth = reflectance * traced.irradiance[i].mean[c];
            squares += (shown - truth) * (shown - truth) / n;
            noise += std::pow(reflectance * traced.irradiance[i].standardError[c], 2.0) / n;
            result.bias += (shown - truth) / n;
            result.mean += truth / n;
            result.differences.back() += (shown - truth) / 3.0;
            result.truths.back() += truth / 3.0;
        }
    }
    result.error = std::sqrt(std::max(0.0, squares - noise)) / result.mean;
    result.standardError = std::sqrt(noise) / result.mean;
    result.bias /= result.mean;
    return result;
}

}  // namespace fluxwalk::test
