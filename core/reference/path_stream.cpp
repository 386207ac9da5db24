#include "core/reference/path_stream.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"

namespace fluxwalk::reference {

using base::kPi;

void PathStream::trace(const scene::Sensor& sensor, std::uint64_t key, std::uint64_t first,
                       std::span<Vec3d> samples) {
    FLUXWALK_CHECK_LE(samples.size(), kLargest);
    paths_.clear();
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        samples[i] = Vec3d(0.0);
        paths_.push_back({sensor.position, sensor.normal, Vec3d(1.0), Vec3d(0.0),
                          base::RandomStream(base::combine(key, first + i)), i});
    }
    while (!paths_.empty()) {
        for (Path& path : paths_) {
            addLights(path);
            addEmitterSample(path);
        }
        castShadowRays(samples);
        castPaths(samples);
    }
}

void PathStream::queue(const rays::Ray& ray, const Arrival& arrival) {
    shadowRays_.push_back(ray);
    arrivals_.push_back(arrival);
}

void PathStream::castShadowRays(std::span<Vec3d> samples) {
    blocked_.resize(shadowRays_.size());
    shaded_.rays().occluded(shadowRays_, blocked_);
    rays_ += shadowRays_.size();
    for (std::size_t i = 0; i < arrivals_.size(); ++i) {
        if (blocked_[i] == 0) {
            samples[arrivals_[i].sample] += arrivals_[i].irradiance;
        }
    }
    shadowRays_.clear();
    arrivals_.clear();
}

// Every path goes on by one ray; those that end leave the list.
void PathStream::castPaths(std::span<Vec3d> samples) {
    const std::size_t count = paths_.size();
    for (std::size_t i = 0; i < count; ++i) {
        Path& path = paths_[i];
        path.direction = cosineDirection(path.normal, path.random.next2());
        onward_[i] = shaded_.rays().halfLine(path.position, path.normal, path.direction);
    }
    shaded_.rays().closest(std::span(onward_.data(), count), std::span(hits_.data(), count));
    rays_ += count;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Path& path = paths_[i];
        if (!hits_[i]) {
            if (path.direction.y > 0.0) {
                samples[path.sample] += path.throughput * Vec3d(shaded_.scene().sky);
            }
            continue;
        }
        if (goOn(path, shaded_.at(onward_[i], *hits_[i]), samples)) {
            if (kept != i) {
                paths_[kept] = path;
            }
            ++kept;
        }
    }
    paths_.resize(kept, paths_.front());
}

// Takes the light of a surface that was met; whether the path goes on from there.
bool PathStream::goOn(Path& path, const SidePoint& met, std::span<Vec3d> samples) {
    if (met.emission != Rgb(0.0f)) {
        const double cosine = glm::dot(path.normal, path.direction);
        const double cosineAtY = -glm::dot(met.normal, path.direction);
        const double weight =
            cosineAtY > 0.0 ? cosine / (cosine + emitterDensity(path.position, met, cosineAtY)) : 1.0;
        samples[path.sample] += path.throughput * Vec3d(met.emission) * weight;
    }
    path.throughput *= Vec3d(met.reflectance);
    const double survival = std::max({path.throughput.x, path.throughput.y, path.throughput.z});
    if (!(path.random.next() < survival)) {
        return false;
    }
    path.throughput /= std::min(1.0, survival);
    path.position = met.position;
    path.normal = met.normal;
    return true;
}

// Density, per solid angle times pi, with which sampleEmitter finds `y` from `x`.
double PathStream::emitterDensity(const Vec3d& x, const SidePoint& y, double cosineAtY) const {
    const Vec3d between = y.position - x;
    return kPi * shaded_.emitterProbability(y.object, y.patch) * glm::dot(between, between) /
           (y.measure * cosineAtY);
}

void PathStream::addEmitterSample(Path& path) {
    if (!shaded_.hasEmissivePatches()) {
        return;
    }
    SidePoint y = shaded_.sampleEmitter(path.random);
    const Vec3d between = y.position - path.position;
    const double distance = glm::length(between);
    const double cosine = glm::dot(path.normal, between) / distance;
    double cosineAtY = -glm::dot(y.normal, between) / distance;
    if (cosineAtY < 0.0 &&
        shaded_.scene().materials[shaded_.scene().objects[y.object].material].doubleSided) {
        cosineAtY = -cosineAtY;
        y.normal = -y.normal;
    }
    if (!(cosine > 0.0) || !(cosineAtY > 0.0)) {
        return;
    }
    const double weight = cosine / (cosine + emitterDensity(path.position, y, cosineAtY));
    queue(shaded_.rays().segment(path.position, path.normal, y.position, y.normal),
          {path.throughput * Vec3d(y.emission) * weight, path.sample});
}

void PathStream::addLights(const Path& path) {
    for (const scene::Light& light : shaded_.scene().lights) {
        const bool isDirectional = light.kind == scene::LightKind::directional;
        const Vec3d between = isDirectional ? -light.direction : light.position - path.position;
        const double distance = glm::length(between);
        const Vec3d direction = between / distance;
        const double cosine = glm::dot(path.normal, direction);
        if (!(cosine > 0.0) || (light.range > 0.0 && !isDirectional && distance > light.range)) {
            continue;
        }
        const rays::RayScene& rays = shaded_.rays();
        const double falloff = isDirectional ? 1.0 : 1.0 / (distance * distance);
        queue(isDirectional ? rays.halfLine(path.position, path.normal, direction)
                            : rays.segment(path.position, path.normal, light.position, Vec3d(0.0)),
              {path.throughput *
                   Vec3d(isDirectional ? light.intensity : scene::intensityToward(light, -direction)) *
                   (cosine * falloff),
               path.sample});
    }
}

}  // namespace fluxwalk::reference
