#include "core/reference/path_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/reference/shaded_scene.h"

namespace fluxwalk::reference {

namespace {

using base::kPi;

/// Paths that one task traces.
constexpr std::uint64_t kChunk = 1024;

class PathTracer {
  public:
    PathTracer(const ShadedScene& shaded, base::RandomStream random) : shaded_(shaded), random_(random) {}

    // One sample of the irradiance at a point.
    Vec3d trace(Vec3d position, Vec3d normal) {
        const scene::Scene& scene = shaded_.scene();
        Vec3d irradiance(0.0);
        Vec3d throughput(1.0);
        while (true) {
            irradiance += throughput * (fromLights(position, normal) + fromEmitterSample(position, normal));
            const Vec3d direction = cosineDirection(normal, random_.next2());
            ++rays_;
            const auto met = shaded_.closest(shaded_.rays().halfLine(position, normal, direction));
            if (!met) {
                return direction.y > 0.0 ? irradiance + throughput * Vec3d(scene.sky) : irradiance;
            }
            if (met->emission != Rgb(0.0f)) {
                irradiance += throughput * Vec3d(met->emission) *
                              weightOfRay(position, glm::dot(normal, direction), direction, *met);
            }
            throughput *= Vec3d(met->reflectance);
            const double survival = std::max({throughput.x, throughput.y, throughput.z});
            if (!(random_.next() < survival)) {
                return irradiance;
            }
            throughput /= std::min(1.0, survival);
            position = met->position;
            normal = met->normal;
        }
    }

    std::uint64_t rays() const { return rays_; }

  private:
    // Density, per solid angle times pi, with which sampleEmitter finds `y` from `x`.
    double emitterDensity(const Vec3d& x, const SidePoint& y, double cosineAtY) const {
        const Vec3d between = y.position - x;
        return kPi * shaded_.emitterProbability(y.object, y.patch) * glm::dot(between, between) /
               (y.measure * cosineAtY);
    }

    double weightOfRay(const Vec3d& x, double cosine, const Vec3d& direction, const SidePoint& y) const {
        const double cosineAtY = -glm::dot(y.normal, direction);
        return cosineAtY > 0.0 ? cosine / (cosine + emitterDensity(x, y, cosineAtY)) : 1.0;
    }

    Vec3d fromEmitterSample(const Vec3d& position, const Vec3d& normal) {
        if (!shaded_.hasEmissivePatches()) {
            return Vec3d(0.0);
        }
        SidePoint y = shaded_.sampleEmitter(random_);
        const Vec3d between = y.position - position;
        const double distance = glm::length(between);
        const double cosine = glm::dot(normal, between) / distance;
        double cosineAtY = -glm::dot(y.normal, between) / distance;
        if (cosineAtY < 0.0 &&
            shaded_.scene().materials[shaded_.scene().objects[y.object].material].doubleSided) {
            cosineAtY = -cosineAtY;
            y.normal = -y.normal;
        }
        if (!(cosine > 0.0) || !(cosineAtY > 0.0)) {
            return Vec3d(0.0);
        }
        ++rays_;
        if (shaded_.rays().isOccluded(shaded_.rays().segment(position, normal, y.position, y.normal))) {
            return Vec3d(0.0);
        }
        return Vec3d(y.emission) * (cosine / (cosine + emitterDensity(position, y, cosineAtY)));
    }

    Vec3d fromLights(const Vec3d& position, const Vec3d& normal) {
        Vec3d sum(0.0);
        for (const scene::Light& light : shaded_.scene().lights) {
            const bool isDirectional = light.kind == scene::LightKind::directional;
            const Vec3d between = isDirectional ? -light.direction : light.position - position;
            const double distance = glm::length(between);
            const Vec3d direction = between / distance;
            const double cosine = glm::dot(normal, direction);
            if (!(cosine > 0.0) || (light.range > 0.0 && !isDirectional && distance > light.range)) {
                continue;
            }
            ++rays_;
            const rays::Ray ray = isDirectional
                                      ? shaded_.rays().halfLine(position, normal, direction)
                                      : shaded_.rays().segment(position, normal, light.position, Vec3d(0.0));
            if (shaded_.rays().isOccluded(ray)) {
                continue;
            }
            const double falloff = isDirectional ? 1.0 : 1.0 / (distance * distance);
            sum += Vec3d(isDirectional ? light.intensity : scene::intensityToward(light, -direction)) *
                   (cosine * falloff);
        }
        return sum;
    }

    const ShadedScene& shaded_;
    base::RandomStream random_;
    std::uint64_t rays_ = 0;
};

}  // namespace

PathResult traceIrradiance(const scene::Scene& scene, const rays::RayScene& rays,
                           const base::Executor& executor, std::span<const scene::Sensor> sensors,
                           const PathOptions& options) {
    FLUXWALK_CHECK_LE(std::uint64_t{2}, options.paths);
    const ShadedScene shaded(scene, rays);
    const std::uint64_t chunks = (options.paths + kChunk - 1) / kChunk;
    struct Partial {
        SampleSums sums;
        std::uint64_t rays = 0;
    };
    std::vector<Partial> partials(sensors.size() * chunks);
    executor.forRange(partials.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t task = begin; task < end; ++task) {
            const std::size_t sensor = task / chunks;
            const std::uint64_t first = (task % chunks) * kChunk;
            const std::uint64_t last = std::min(options.paths, first + kChunk);
            const std::uint64_t key = base::combine(options.seed, sensor);
            for (std::uint64_t path = first; path < last; ++path) {
                PathTracer tracer(shaded, base::RandomStream(base::combine(key, path)));
                partials[task].sums.add(tracer.trace(sensors[sensor].position, sensors[sensor].normal));
                partials[task].rays += tracer.rays();
            }
        }
    });
    PathResult result;
    result.irradiance.reserve(sensors.size());
    for (std::size_t sensor = 0; sensor < sensors.size(); ++sensor) {
        SampleSums sums;
        for (std::uint64_t chunk = 0; chunk < chunks; ++chunk) {
            const Partial& partial = partials[sensor * chunks + chunk];
            sums.add(partial.sums);
            result.rays += partial.rays;
        }
        result.irradiance.push_back(sums.estimate());
    }
    return result;
}

}  // namespace fluxwalk::reference
