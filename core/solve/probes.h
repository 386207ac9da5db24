#pragma once

#include <vector>

#include "core/solve/point_gather.h"

namespace fluxwalk::solve {

/// A random point of a side that light reaches.
struct Probe {
    std::uint32_t object = 0;
    std::uint32_t patch = 0;
    bool back = false;
    base::Vec2d uv{};
    Vec3d position{};
    Vec3d normal{};
};

/// Points drawn by area over all reached sides, hidden parts left out; the same for the same seed.
std::vector<Probe> drawProbes(const Problem& problem, std::size_t count, std::uint64_t seed);

/// Irradiance at probes by point gather, in lux.
std::vector<Rgb> gatherProbes(const Problem& problem, const std::vector<Probe>& probes);

/// RMS of the difference over probes and channels, as a part of the mean of `reference`.
double relativeRms(const std::vector<Rgb>& values, const std::vector<Rgb>& reference);

/// The same without probes where `reference` is more than ten times the mean of all others that are left: a
/// point on the socket of a lamp may have a hundred times the light of a room, and its mean would hide all
/// else.
double relativeRmsOffLamps(const std::vector<Rgb>& values, const std::vector<Rgb>& reference);

}  // namespace fluxwalk::solve
