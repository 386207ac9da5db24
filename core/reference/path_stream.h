#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/reference/shaded_scene.h"
#include "core/scene/sensor.h"

namespace fluxwalk::reference {

/// Paths from one sensor that go on together, so that rays are cast in bundles. Each has random numbers of
/// its own: what it finds does not depend on its company. For one thread; made once and used again.
class PathStream {
  public:
    /// Most paths in one stream.
    static constexpr std::size_t kLargest = 64;

    explicit PathStream(const ShadedScene& shaded) : shaded_(shaded) {}

    /// Irradiance in lux that paths number `first` and following bring to a sensor, one value for each;
    /// `samples` holds at most kLargest. `key` names the sensor.
    void trace(const scene::Sensor& sensor, std::uint64_t key, std::uint64_t first, std::span<Vec3d> samples);

    /// Cast so far.
    std::uint64_t rays() const { return rays_; }

  private:
    struct Path {
        Vec3d position;
        Vec3d normal;
        Vec3d throughput;
        Vec3d direction;  ///< of the ray that goes on
        base::RandomStream random;
        std::uint32_t sample;
    };
    /// Light that arrives unless its ray is blocked.
    struct Arrival {
        Vec3d irradiance;
        std::uint32_t sample;
    };

    void addLights(const Path& path);
    void addEmitterSample(Path& path);
    void castShadowRays(std::span<Vec3d> samples);
    void castPaths(std::span<Vec3d> samples);
    bool goOn(Path& path, const SidePoint& met, std::span<Vec3d> samples);
    void queue(const rays::Ray& ray, const Arrival& arrival);

    double emitterDensity(const Vec3d& x, const SidePoint& y, double cosineAtY) const;

    const ShadedScene& shaded_;
    std::vector<Path> paths_;
    std::vector<rays::Ray> shadowRays_;
    std::vector<Arrival> arrivals_;
    std::vector<std::uint8_t> blocked_;
    std::array<rays::Ray, kLargest> onward_{};
    std::array<std::optional<rays::Hit>, kLargest> hits_{};
    std::uint64_t rays_ = 0;
};

}  // namespace fluxwalk::reference
