#pragma once

#include "core/base/simd.h"
#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::transport {

using base::Lanes;
using base::NodeId;
using base::Vec3d;

/// An element as kernels see it: eight points of the true surface with true normals. Lanes 0..3 are cubature points (2 x 2 Gauss of
/// the region, or three points of a triangle) whose weights sum to 1, the others are the corners (weight 0), which show what
/// cubature misses: a horizon that crosses the element, and the full range of the kernel.
struct ElementPoints {
    base::Lanes3 position;
    base::Lanes3 normal;
    Lanes weight;
    std::array<Vec3d, 4> corners{};
    std::uint32_t cornerCount = 0;
    Vec3d axis{};  ///< normal of a planar element
    Vec3d center{};
    double radius = 0.0;
    double area = 0.0;  ///< m2
    bool isPlanar = true;
};

ElementPoints makeElementPoints(const hierarchy::Hierarchy& hierarchy, NodeId id);

/// Denser cubature of a planar element: 4 x 4 Gauss points in two blocks of lanes, weights sum to 1 over both.
struct DensePoints {
    std::array<base::Lanes3, 2> position;
    std::array<Lanes, 2> weight;
};
DensePoints makeDensePoints(const ElementPoints& element);

}  // namespace fluxwalk::transport
