#pragma once

#include <cstdint>
#include <limits>

/// What tree builders move about: a box, the normals in it and its index, in vectors of four floats.
namespace fluxwalk::rays {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 minOf(Float4 a, Float4 b) {
    return a < b ? a : b;
}
inline Float4 maxOf(Float4 a, Float4 b) {
    return a > b ? a : b;
}

/// Coordinates are relative to the middle of all boxes, in units of their largest extent, so that nothing
/// overflows and a far-off origin costs no digits. The fourth lanes of the corners hold the two halves of the
/// index as numbers: as bits they could be denormal, on which every addition would stall.
struct BuildItem {
    Float4 lower;
    Float4 upper;
    Float4 normal;  ///< mean normal times area, in the fourth lane the area

    void setIndex(std::uint32_t index) {
        lower[3] = static_cast<float>(index & 0xffffu);
        upper[3] = static_cast<float>(index >> 16);
    }
    std::uint32_t index() const {
        return static_cast<std::uint32_t>(lower[3]) | (static_cast<std::uint32_t>(upper[3]) << 16);
    }
    /// Twice the middle.
    Float4 center() const { return lower + upper; }
};

/// Corners of a box; empty by default.
struct Extent {
    Float4 lower = Float4{} + std::numeric_limits<float>::infinity();
    Float4 upper = Float4{} - std::numeric_limits<float>::infinity();

    void add(Float4 low, Float4 high) {
        lower = minOf(lower, low);
        upper = maxOf(upper, high);
    }
    Float4 size() const { return upper - lower; }
};

}  // namespace fluxwalk::rays
