#pragma once

#include <array>
#include <cstdint>

#include "core/hierarchy/hierarchy.h"

/// Certain bounds of what elements exchange: from hulls and cones of normals, never from samples.
namespace fluxwalk::transport {

using base::NodeId;
using base::Vec3d;

/// What a form factor lies between.
struct FactorBounds {
    double lower = 0.0;
    double upper = 1.0;
};

/// Part of an element: in the hull of points, with normals in a cone.
struct ElementHull {
    /// Corners of planar parts; of curved ones those of their box, x at its upper end in the odd ones, y in
    /// 2, 3, 6, 7, z in the last four.
    std::array<Vec3d, 8> points{};
    std::uint32_t pointCount = 0;
    Vec3d axis{};
    double cosine = 1.0;  ///< of the half angle of the cone
    double sine = 0.0;
};

/// What a part sends.
struct SourcePart {
    ElementHull hull;
    double area = 0.0;      ///< m2
    Vec3d vectorArea{0.0};  ///< integral of the normals, m2
    Vec3d centroid{};
    double turning = 0.0;  ///< integral of |normal - mean normal| |position - centroid|, m3
    double inertia = 0.0;  ///< integral of |position - centroid|2, m4
};

/// Where an element sends: quarters of a planar one, 4 x 4 parts of a curved one.
struct SourceParts {
    std::array<SourcePart, 16> parts{};
    std::size_t count = 0;
    Vec3d center{};  ///< of the sphere around all of it
    double radius = 0.0;
};

SourceParts makeSourceParts(const hierarchy::Hierarchy& hierarchy, NodeId id);

/// Bounds, without occlusion, of the form factor from any point of `receiver` to the whole of the source. The
/// upper one is at most 1, also where the two may touch. The receiver is quartered where it holds one of the
/// extremes. (ALGORITHMS 1.4; Lischinski et al. 1994, Stamminger et al. 1997.)
FactorBounds boundPointFactor(const hierarchy::Hierarchy& hierarchy, NodeId receiver,
                              const SourceParts& source);

}  // namespace fluxwalk::transport
