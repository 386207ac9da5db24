#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/hierarchy/hierarchy.h"
#include "core/rays/ray_scene.h"

namespace fluxwalk::transport {

using base::NodeId;
using base::Vec3;
using base::Vec3d;

/// What a look into the space between two elements proves.
enum class ShaftContent : std::uint8_t {
    unknown,
    empty,   ///< nothing stands between them: every point of one sees every point of the other that faces it
    blocked  ///< one polygon cuts all lines between them
};

/// Convex hull of the boxes of two elements, cut by their own planes (Haines and Wallace 1991).
class Shaft {
  public:
    Shaft(const hierarchy::Shape& a, const hierarchy::Shape& b, double tolerance);

    /// True only if no point of the box lies strictly inside.
    bool excludes(const Vec3& lower, const Vec3& upper) const;
    /// True only if no point of the convex polygon lies strictly inside.
    bool excludes(std::span<const Vec3d> polygon) const;

  private:
    void addPlane(const Vec3d& normal, double offset);

    static constexpr std::size_t kMaxPlanes = 20;
    Vec3 lower_{};
    Vec3 upper_{};
    std::array<Vec3, kMaxPlanes> normals_{};
    std::array<float, kMaxPlanes> offsets_{};  ///< inside: dot(normal, x) < offset
    std::size_t planeCount_ = 0;
};

/// Tolerance in metres with which rays between two nodes, which start off their surfaces, keep to what a
/// certificate says.
double shaftTolerance(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a, NodeId b);

/// Looks for occluders between two elements. Certain in both directions: `empty` and `blocked` need no rays,
/// here and for all descendants of the pair.
ShaftContent inspectShaft(const hierarchy::Hierarchy& hierarchy, NodeId a, NodeId b, double tolerance);

/// Whether one polygon, the one that the line between their centres meets, cuts all lines between two nodes
/// of which at least one is a cluster. Certain, for all that is below the two, too.
bool isCutOff(const hierarchy::Hierarchy& hierarchy, const rays::RayScene& rays, NodeId a, NodeId b,
              double tolerance);

}  // namespace fluxwalk::transport
