#pragma once

#include "core/image/final_gather.h"
#include "core/scene/sensor.h"

/// Stills against the path tracer.
namespace fluxwalk::test {

/// Middles of every `step`-th pixel of every `step`-th row that see something lit.
struct StillPoints {
    std::vector<std::size_t> pixels;
    /// With the normal that is shaded.
    std::vector<scene::Sensor> sensors;
    std::vector<base::Rgb> reflectance;
};
StillPoints findStillPoints(const solve::Problem& problem, const scene::Camera& camera,
                            const image::StillOptions& options, std::uint32_t step);

struct StillErrors {
    double error = 0.0;          ///< RMS of the luminance over pixels and channels, relative to its mean
    double bias = 0.0;           ///< mean of the difference, likewise
    double standardError = 0.0;  ///< of the reference, likewise; taken off `error`
    double mean = 0.0;           ///< luminance of the channels, cd/m2
    /// Mean over the channels of difference and truth at each point, cd/m2.
    std::vector<double> differences;
    std::vector<double> truths;
};
/// Light reflected at these points in a still of one sample a pixel, against `paths` paths for each.
StillErrors compareStill(const solve::Problem& problem, const image::Still& still, const StillPoints& points,
                         std::uint64_t paths);

}  // namespace fluxwalk::test
