#include "core/reference/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/check.h"
#include "core/reference/path_stream.h"

namespace fluxwalk::reference {

static_assert(IrradianceTracer::kGroup <= PathStream::kLargest);

IrradianceTracer::IrradianceTracer(const scene::Scene& scene, const rays::RayScene& rays,
                                   const base::Executor& executor, std::span<const scene::Sensor> sensors,
                                   std::uint64_t seed)
    : shaded_(scene, rays),
      executor_(executor),
      sensors_(sensors.begin(), sensors.end()),
      seed_(seed),
      sums_(sensors.size()) {}

void IrradianceTracer::add(std::uint64_t paths, const std::function<bool()>& shouldStop) {
    // Groups begin at multiples of their size, so that sums are taken in one order in however many calls.
    FLUXWALK_CHECK_EQ(paths_ % kGroup, std::uint64_t{0});
    const std::uint64_t groups = (paths + kGroup - 1) / kGroup;
    struct Partial {
        Halves sums;
        std::uint64_t rays = 0;
    };
    std::vector<Partial> partials(sensors_.size() * groups);
    std::atomic<bool> isStopped = false;
    executor_.forRange(partials.size(), 4, [&](std::size_t begin, std::size_t end) {
        PathStream stream(shaded_);
        std::array<Vec3d, kGroup> samples;
        for (std::size_t task = begin; task < end; ++task) {
            if (isStopped || (shouldStop && shouldStop())) {
                isStopped = true;
                return;
            }
            const std::size_t sensor = task / groups;
            const std::uint64_t offset = (task % groups) * kGroup;
            const std::span<Vec3d> part(samples.data(), std::min(kGroup, paths - offset));
            const std::uint64_t before = stream.rays();
            stream.trace(sensors_[sensor], base::combine(seed_, sensor), paths_ + offset, part);
            for (std::size_t i = 0; i < part.size(); ++i) {
                partials[task].sums[i % 2].add(part[i]);
            }
            partials[task].rays = stream.rays() - before;
        }
    });
    for (std::size_t task = 0; task < partials.size(); ++task) {
        Halves& sums = sums_[task / groups];
        for (std::size_t half = 0; half < 2; ++half) {
            sums[half].add(partials[task].sums[half]);
        }
        rays_ += partials[task].rays;
    }
    paths_ += paths;
}

std::vector<Estimate> IrradianceTracer::irradiance() const {
    std::vector<Estimate> result;
    result.reserve(sums_.size());
    for (const Halves& halves : sums_) {
        SampleSums all = halves[0];
        all.add(halves[1]);
        result.push_back(all.estimate());
    }
    return result;
}

NoiseCheck IrradianceTracer::checkNoise() const {
    NoiseCheck check;
    double sum = 0.0;
    for (const Halves& halves : sums_) {
        const Estimate even = halves[0].estimate();
        const Estimate odd = halves[1].estimate();
        const double variance =
            even.luminanceError * even.luminanceError + odd.luminanceError * odd.luminanceError;
        if (std::isfinite(variance) && variance > 0.0) {
            const double difference = even.luminance - odd.luminance;
            sum += difference * difference / variance;
            ++check.count;
        }
    }
    if (check.count > 0) {
        const auto n = static_cast<double>(check.count);
        check.ratio = sum / n;
        check.deviation = std::sqrt(2.0 / n);
    }
    return check;
}

PathResult traceIrradiance(const scene::Scene& scene, const rays::RayScene& rays,
                           const base::Executor& executor, std::span<const scene::Sensor> sensors,
                           const PathOptions& options) {
    FLUXWALK_CHECK_LE(std::uint64_t{2}, options.paths);
    IrradianceTracer tracer(scene, rays, executor, sensors, options.seed);
    // In parts, for the memory of what they bring.
    constexpr std::uint64_t kPart = 64 * IrradianceTracer::kGroup;
    while (tracer.paths() < options.paths) {
        tracer.add(std::min(kPart, options.paths - tracer.paths()));
    }
    return {tracer.irradiance(), tracer.rays()};
}

}  // namespace fluxwalk::reference
