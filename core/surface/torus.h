#pragma once

#include "core/surface/affine_map.h"
#include "core/surface/turns.h"

namespace fluxwalk::surface {

/// Torus about +Y, centred, in 4 x 4 patches: patch 4 j + i is the i-th quarter turn of the ring and the j-th
/// of the tube, from its outermost circle upwards. u runs around the ring from +X over -Z (to the other side
/// where that keeps the corners counter-clockwise), v around the tube. The front is the outside of the tube.
class Torus final : public Surface {
  public:
    /// Radii of the ring (of the tube's centre line) and of the tube in local units, 0 < minor <= major.
    /// `inside` turns the normals into the tube.
    Torus(const base::Mat4d& worldFromLocal, double majorRadius, double minorRadius, bool inside = false);

    std::string_view kind() const override { return "torus"; }
    std::uint32_t patchCount() const override { return 16; }
    PatchDomain domain(std::uint32_t /*patch*/) const override { return PatchDomain::quad; }
    SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const override;
    Strips strips(std::uint32_t /*patch*/) const override { return strips_; }
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const override;
    /// As on Blender's torus: u once around the ring, v once around the tube, seams at -X and innermost.
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool isPlanar(std::uint32_t /*patch*/) const override { return false; }
    /// From inside the tube always; from outside only the saddle-shaped inner half.
    bool canSeeItself(std::uint32_t patch, bool back) const override;
    /// The exact box, and the cone of its normals up to a few percent. Regions that do not run along u and v
    /// get those of the least one around them that does.
    RegionBounds bounds(std::uint32_t patch, const Region& region) const override;
    bool normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const override;
    /// To rounding under similarities for regions along u and v, else to about 1e-12.
    double area(std::uint32_t patch, const Region& region) const override;
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;
    Box bounds() const override;

    /// Takes the torus whose ring has radius 1, and whose tube has radius tube(), to its place.
    const AffineMap& map() const { return map_; }
    double tube() const { return tube_; }
    bool isInside() const { return inside_; }

  private:
    double partOf(double u) const { return clockwise_ ? 1.0 - u : u; }
    /// Directions whose combinations are the normals, of either side.
    std::array<Vec3d, 16> normalHull(const Arc& ring, const Arc& tube) const;
    Arc ringArc(std::uint32_t patch, double u0, double u1) const;
    Vec2d locateUnit(std::uint32_t patch, const Vec3d& unit) const;

    AffineMap map_;
    /// Radius of the tube where the ring's is 1.
    double tube_;
    /// Factor of the lengths of the unit form where the map is a similarity, 0 otherwise.
    double scale_;
    bool inside_;
    /// Whether u runs against the turn.
    bool clockwise_;
    Strips strips_;
};

}  // namespace fluxwalk::surface
