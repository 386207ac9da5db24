#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/sensor.h"

namespace fluxwalk::reference {

/// One side of one object.
struct ObjectSide {
    std::uint32_t object = 0;
    bool back = false;
};

/// Seed of the published benchmark sensors.
inline constexpr std::uint64_t kBenchmarkSeed = 1996;
inline constexpr std::size_t kBenchmarkSensors = 1000;

/// `count` sensors drawn by area over the given sides, so that each m2 has the same chance. A pure function
/// of its arguments.
std::vector<scene::Sensor> randomSensors(const scene::Scene& scene, std::span<const ObjectSide> sides,
                                         std::size_t count, std::uint64_t seed);

}  // namespace fluxwalk::reference
