#pragma once

#include "core/base/simd.h"
#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::transport {

using base::Lanes;
using base::NodeId;
using base::Vec3d;

/// An element as kernels see it: eight points of the true surface with true normals. Lanes 0..3 are cubature
/// points (2 x 2 Gauss of the region, or three points of a triangle) whose weights sum to 1, the others are
/// the corners (weight 0), which show what cubature misses: a horizon that crosses the element, and the full
/// range of the kernel.
struct alignas(base::kLanesAlignment) ElementPoints {
    base::Lanes3 position;
    base::Lanes3 normal;
    Lanes weight;
    std::array<Vec3d, 4> corners{};
    std::uint32_t cornerCount = 0;
    /// Boundary: the corners of a planar element; of a curved one also a point for each edge, off the edge's
    /// middle by 4/3 of its rise over the chord, so that the triangle on the chord has the area of the arc.
    std::array<Vec3d, 8> contour{};
    std::uint32_t contourCount = 0;
    Vec3d axis{};  ///< normal of a planar element
    Vec3d center{};
    double radius = 0.0;
    double area = 0.0;  ///< m2
    bool isPlanar = true;
    bool isFlat = true;  ///< all normals are alike; its edges may be curved
};

ElementPoints makeElementPoints(const hierarchy::Hierarchy& hierarchy, NodeId id);
/// The same for a region within that of an element.
ElementPoints makeRegionPoints(const hierarchy::Hierarchy& hierarchy, NodeId element,
                               const surface::Region& region);

/// Coordinates of the eight points within their element, 0 in the middle, in the order of the shape's
/// corners. Quads: (2 s - 1, 2 t - 1). Triangles: (u - 1/3, v - 1/3) with u, v the barycentric weights of
/// corners 1 and 2.
const std::array<base::Vec2d, base::kLanes>& localPointCoordinates(std::uint32_t cornerCount);

/// Denser cubature of a planar element: 4 x 4 Gauss points in two blocks of lanes, weights sum to 1 over
/// both.
struct alignas(base::kLanesAlignment) DensePoints {
    std::array<base::Lanes3, 2> position;
    std::array<Lanes, 2> weight;
};
DensePoints makeDensePoints(const ElementPoints& element);

}  // namespace fluxwalk::transport
