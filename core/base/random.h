#pragma once

#include <cstdint>

#include "core/base/vec.h"

/// Counter-based randomness: every number is a pure function of a key made from names (object, patch, path,
/// ...), so results do not depend on the order or the number of threads that draw.
namespace fluxwalk::base {

/// Bijective 64-bit mixer (Stafford's variant 13 of the MurmurHash3 finaliser).
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Extends a key by one more component; order matters.
constexpr std::uint64_t combine(std::uint64_t key, std::uint64_t component) {
    return mix(key + 0x9e3779b97f4a7c15ULL + mix(component + 0x632be59bd9b4e019ULL));
}

/// Uniform in [0, 1), from the top 53 bits.
constexpr double toUnit(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

/// A stream of numbers under one key; cheap to make, nothing to share.
class RandomStream {
  public:
    explicit constexpr RandomStream(std::uint64_t key) : key_(key) {}
    constexpr double next() { return toUnit(mix(key_ + 0x9e3779b97f4a7c15ULL * ++counter_)); }
    Vec2d next2() {
        const double x = next();
        return {x, next()};
    }

  private:
    std::uint64_t key_;
    std::uint64_t counter_ = 0;
};

/// i-th point of the R2 sequence (M. Roberts 2018: the plastic number), shifted by `shift` modulo 1.
inline Vec2d r2Point(std::uint64_t i, const Vec2d& shift) {
    const auto n = static_cast<double>(i + 1);
    const double x = shift.x + n * 0.7548776662466927;
    const double y = shift.y + n * 0.5698402909980532;
    return {x - static_cast<double>(static_cast<std::int64_t>(x)),
            y - static_cast<double>(static_cast<std::int64_t>(y))};
}

}  // namespace fluxwalk::base
