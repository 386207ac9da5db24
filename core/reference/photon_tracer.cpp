#include "core/reference/photon_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/reference/shaded_scene.h"
#include "core/surface/region.h"

namespace fluxwalk::reference {

namespace {

using base::kPi;

constexpr std::size_t kBatches = 64;

/// A particle at its start: where it flies, and the flux in lm that it stands for, before the division by the
/// number of particles.
struct Particle {
    rays::Ray ray;
    Vec3d flux{0.0};
};

Vec3d sphereDirection(const Vec2d& random) {
    const double z = 1.0 - 2.0 * random.x;
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi = 2.0 * kPi * random.y;
    return {radius * std::cos(phi), radius * std::sin(phi), z};
}

/// All that emits, chosen by power: the patches together, each light, the sky.
class Source {
  public:
    explicit Source(const ShadedScene& shaded) : shaded_(shaded) {
        const base::Box bounds = shaded.scene().bounds();
        center_ = bounds.center();
        radius_ = 0.5 * bounds.diagonal();
        addPower(shaded.emitterPower());
        for (const scene::Light& light : shaded.scene().lights) {
            addPower(static_cast<double>(
                base::channelMean(light.kind == scene::LightKind::directional
                                      ? light.intensity * static_cast<float>(crossSection())
                                      : scene::fluxOf(light))));
        }
        addPower(2.0 * crossSection() * static_cast<double>(base::channelMean(shaded.scene().sky)));
    }

    double power() const { return cumulative_.back(); }

    Particle emit(base::RandomStream& random) const {
        const double choice = random.next() * power();
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), choice);
        const auto index =
            std::min(static_cast<std::size_t>(found - cumulative_.begin()), cumulative_.size() - 1);
        const double probability =
            (cumulative_[index] - (index > 0 ? cumulative_[index - 1] : 0.0)) / power();
        Particle particle = index == 0 ? fromPatches(random)
                            : index + 1 == cumulative_.size()
                                ? fromSky(random)
                                : fromLight(shaded_.scene().lights[index - 1], random);
        particle.flux /= probability;
        return particle;
    }

  private:
    double crossSection() const { return kPi * radius_ * radius_; }
    void addPower(double power) {
        cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + power);
    }

    Particle fromPatches(base::RandomStream& random) const {
        SidePoint from = shaded_.sampleEmitter(random);
        double sides = 1.0;
        if (shaded_.scene().materials[shaded_.scene().objects[from.object].material].doubleSided) {
            sides = 2.0;
            from.normal = random.next() < 0.5 ? from.normal : -from.normal;
        }
        const Vec3d direction = cosineDirection(from.normal, random.next2());
        const double density = shaded_.emitterProbability(from.object, from.patch) / from.measure;
        return {shaded_.rays().halfLine(from.position, from.normal, direction),
                Vec3d(from.emission) * (sides / density)};
    }

    Particle fromLight(const scene::Light& light, base::RandomStream& random) const {
        if (light.kind == scene::LightKind::directional) {
            return throughBounds(light.direction, Vec3d(light.intensity) * crossSection(), random);
        }
        // A spot's particles fill the cone of its outer angle.
        const double lowest = light.kind == scene::LightKind::spot ? std::cos(light.outerConeAngle) : -1.0;
        const double solidAngle = 2.0 * kPi * (1.0 - lowest);
        const double cosine = 1.0 - (1.0 - lowest) * random.next();
        const Vec3d local = cosineDirection(light.direction, {1.0 - cosine * cosine, random.next()});
        const Vec3d direction = cosine >= 0.0 ? local : local + 2.0 * cosine * light.direction;
        return {shaded_.rays().halfLine(light.position, Vec3d(0.0), direction),
                Vec3d(scene::intensityToward(light, direction)) * solidAngle};
    }

    Particle fromSky(base::RandomStream& random) const {
        Vec3d upward = sphereDirection(random.next2());
        upward.y = std::abs(upward.y);
        return throughBounds(-upward, Vec3d(shaded_.scene().sky) * (2.0 * crossSection()), random);
    }

    // Parallel light through the great circle of the bounding sphere.
    Particle throughBounds(const Vec3d& direction, const Vec3d& flux, base::RandomStream& random) const {
        const Vec3d onDisc = cosineDirection(direction, random.next2());
        const Vec3d offset = radius_ * (onDisc - glm::dot(onDisc, direction) * direction);
        return {shaded_.rays().halfLine(center_ + offset - 1.01 * radius_ * direction, Vec3d(0.0), direction),
                flux};
    }

    const ShadedScene& shaded_;
    Vec3d center_{};
    double radius_ = 0.0;
    /// Patches, then lights, then the sky.
    std::vector<double> cumulative_;
};

/// Flux in lm that one batch brought to each (patch, side), and where the rest went.
struct Batch {
    std::vector<std::array<Vec3d, 2>> incident;
    Vec3d emitted{0.0};
    Vec3d absorbed{0.0};
    Vec3d escaped{0.0};
    std::uint64_t rays = 0;
};

void follow(const ShadedScene& shaded, Particle particle, base::RandomStream& random,
            const std::vector<std::size_t>& firstPatch, Batch& batch) {
    batch.emitted += particle.flux;
    while (true) {
        ++batch.rays;
        const std::optional<SidePoint> met = shaded.closest(particle.ray);
        if (!met) {
            batch.escaped += particle.flux;
            return;
        }
        const Vec3d reflectance(met->reflectance);
        batch.incident[firstPatch[met->object] + met->patch][met->back ? 1 : 0] += particle.flux;
        batch.absorbed += particle.flux * (Vec3d(1.0) - reflectance);
        const double survival = std::max({reflectance.x, reflectance.y, reflectance.z});
        if (!(random.next() < survival)) {
            return;
        }
        particle.flux *= reflectance / survival;
        particle.ray =
            shaded.rays().halfLine(met->position, met->normal, cosineDirection(met->normal, random.next2()));
    }
}

}  // namespace

PhotonResult tracePhotons(const scene::Scene& scene, const rays::RayScene& rays,
                          const base::Executor& executor, const PhotonOptions& options) {
    const ShadedScene shaded(scene, rays);
    const Source source(shaded);
    FLUXWALK_CHECK_LT(0.0, source.power());
    std::vector<std::size_t> firstPatch{0};
    for (const scene::Object& object : scene.objects) {
        firstPatch.push_back(firstPatch.back() + object.surface->patchCount());
    }
    const std::uint64_t perBatch = (options.particles + kBatches - 1) / kBatches;
    std::vector<Batch> batches(kBatches);
    executor.forRange(kBatches, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            batches[b].incident.resize(firstPatch.back());
            const std::uint64_t key = base::combine(options.seed, b);
            for (std::uint64_t i = 0; i < perBatch; ++i) {
                base::RandomStream random(base::combine(key, i));
                follow(shaded, source.emit(random), random, firstPatch, batches[b]);
            }
        }
    });

    const double scale = 1.0 / static_cast<double>(perBatch);
    const auto estimate = [&](const auto& valueOf) {
        SampleSums sums;
        for (const Batch& batch : batches) {
            sums.add(scale * valueOf(batch));
        }
        return sums.estimate();
    };
    PhotonResult result;
    result.emitted = estimate([](const Batch& batch) { return batch.emitted; });
    result.absorbed = estimate([](const Batch& batch) { return batch.absorbed; });
    result.escaped = estimate([](const Batch& batch) { return batch.escaped; });
    for (const Batch& batch : batches) {
        result.rays += batch.rays;
    }
    result.objectIrradiance.resize(scene.objects.size());
    result.patchIrradiance.resize(scene.objects.size());
    for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        const surface::Surface& surface = *scene.objects[object].surface;
        const std::uint32_t patchCount = surface.patchCount();
        result.patchIrradiance[object].resize(patchCount);
        double objectArea = 0.0;
        for (std::uint32_t patch = 0; patch < patchCount; ++patch) {
            const double area = surface.area(patch, surface::wholePatch(surface.domain(patch)));
            objectArea += area;
            for (std::size_t side = 0; side < 2; ++side) {
                result.patchIrradiance[object][patch][side] = estimate([&](const Batch& batch) {
                    return batch.incident[firstPatch[object] + patch][side] / area;
                });
            }
        }
        for (std::size_t side = 0; side < 2 && patchCount > 0; ++side) {
            result.objectIrradiance[object][side] = estimate([&](const Batch& batch) {
                Vec3d flux(0.0);
                for (std::uint32_t patch = 0; patch < patchCount; ++patch) {
                    flux += batch.incident[firstPatch[object] + patch][side];
                }
                return flux / objectArea;
            });
        }
    }
    return result;
}

}  // namespace fluxwalk::reference
