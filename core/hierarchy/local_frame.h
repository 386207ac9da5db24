#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"
#include "core/surface/region.h"

/// Coordinates within an element in which its irradiance and radiosity are linear, 0 in the middle. Quads: (2
/// s - 1, 2 t - 1) of the region's unit square. Triangles: (u - 1/3, v - 1/3) with u, v the barycentric
/// weights of the region's corners 1 and 2.
namespace fluxwalk::hierarchy {

struct LocalFrame {
    /// Means over the element of x x, x y (= that of y x) and y y, where x, y are the coordinates.
    float xx;
    float xy;
    float yy;

    /// Mean over the element of (g . local)(h . local).
    float product(const base::Vec2& g, const base::Vec2& h) const {
        return g.x * (xx * h.x + xy * h.y) + g.y * (xy * h.x + yy * h.y);
    }
};

inline constexpr LocalFrame kQuadFrame{1.0f / 3.0f, 0.0f, 1.0f / 3.0f};
inline constexpr LocalFrame kTriangleFrame{1.0f / 18.0f, -1.0f / 36.0f, 1.0f / 18.0f};

constexpr const LocalFrame& localFrame(std::uint32_t cornerCount) {
    return cornerCount == 3 ? kTriangleFrame : kQuadFrame;
}

/// Where the children of an element lie in its coordinates.
struct ChildFrame {
    std::array<std::array<float, 2>, 4> middles;
    /// Factors from a child's coordinates to the whole's.
    std::array<std::array<float, 2>, 4> scales;

    base::Vec2 middle(unsigned child) const { return {middles[child][0], middles[child][1]}; }
    base::Vec2 scale(unsigned child) const { return {scales[child][0], scales[child][1]}; }
};

inline constexpr ChildFrame kQuadQuarters{{{{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}},
                                          {{{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}}}};
/// The middle quarter of a triangle is turned round.
inline constexpr ChildFrame kTriangleQuarters{
    {{{-1.0f / 6.0f, -1.0f / 6.0f}, {1.0f / 3.0f, -1.0f / 6.0f}, {-1.0f / 6.0f, 1.0f / 3.0f}, {0.0f, 0.0f}}},
    {{{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {-0.5f, -0.5f}}}};
inline constexpr ChildFrame kStripsAlongU{{{{-0.75f, 0.0f}, {-0.25f, 0.0f}, {0.25f, 0.0f}, {0.75f, 0.0f}}},
                                          {{{0.25f, 1.0f}, {0.25f, 1.0f}, {0.25f, 1.0f}, {0.25f, 1.0f}}}};
inline constexpr ChildFrame kStripsAlongV{{{{0.0f, -0.75f}, {0.0f, -0.25f}, {0.0f, 0.25f}, {0.0f, 0.75f}}},
                                          {{{1.0f, 0.25f}, {1.0f, 0.25f}, {1.0f, 0.25f}, {1.0f, 0.25f}}}};

constexpr const ChildFrame& childFrame(std::uint32_t cornerCount, surface::Split split) {
    return split == surface::Split::stripsAlongU   ? kStripsAlongU
           : split == surface::Split::stripsAlongV ? kStripsAlongV
           : cornerCount == 3                      ? kTriangleQuarters
                                                   : kQuadQuarters;
}

/// Gradient of the linear function 1 + g . local whose mean times the coordinates is `moment`.
inline base::Vec2d gradientOfMoment(const LocalFrame& frame, const base::Vec2d& moment) {
    const auto xx = static_cast<double>(frame.xx);
    const auto xy = static_cast<double>(frame.xy);
    const auto yy = static_cast<double>(frame.yy);
    return base::Vec2d(yy * moment.x - xy * moment.y, xx * moment.y - xy * moment.x) / (xx * yy - xy * xy);
}

/// A gradient in the order of a back side's corners, which run the other way round, in the order of its
/// region's.
inline base::Vec2 mirrorGradient(std::uint32_t cornerCount, const base::Vec2& g) {
    return cornerCount == 3 ? base::Vec2(g.x - g.y, -g.y) : base::Vec2(g.x, -g.y);
}

}  // namespace fluxwalk::hierarchy
