#pragma once

#include "core/surface/affine_map.h"
#include "core/surface/turns.h"

namespace fluxwalk::surface {

/// What a straight segment sweeps once around an axis, under any affine map: cylinders, cones, frustums,
/// disks and annuli, in four patches of a quarter turn each. They are open. u runs around from +X over -Z (to
/// the other side where that keeps the corners counter-clockwise), v along the segment.
class RevolvedSegment : public Surface {
  public:
    std::uint32_t patchCount() const override { return 4; }
    PatchDomain domain(std::uint32_t /*patch*/) const override { return PatchDomain::quad; }
    /// At a point on the axis: the limit of the normal along u, and no area.
    SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const override;
    Strips strips(std::uint32_t /*patch*/) const override { return strips_; }
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const override;
    /// u once around, as longitudes on Blender's primitives, seam at -X; v down the segment.
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool isPlanar(std::uint32_t /*patch*/) const override { return false; }
    bool canSeeItself(std::uint32_t patch, bool back) const override;
    /// The exact box, and the cone of its normals up to a few percent. Regions that do not run along u and v
    /// get those of the least one around them that does.
    RegionBounds bounds(std::uint32_t patch, const Region& region) const override;
    bool normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const override;
    /// To rounding for regions along u and v, else to about 1e-12.
    double area(std::uint32_t patch, const Region& region) const override;
    Box bounds() const override;

    /// End of the segment in the unit form: distance from the axis +Y, and height.
    struct End {
        double radius = 0.0;
        double height = 0.0;
    };
    const End& first() const { return first_; }
    const End& last() const { return last_; }
    const AffineMap& map() const { return map_; }
    bool isInside() const { return inside_; }

  protected:
    /// v runs from `first` to `last`. Drawn with the axis upwards at the left of the segment, the front is on
    /// the right of this direction, or on its left if `inside`.
    RevolvedSegment(const base::Mat4d& worldFromUnit, const End& first, const End& last, bool inside);

    /// Patch and parameter of a point of the unit form on the surface.
    std::uint32_t patchAt(const Vec3d& unit) const { return quarterOf({unit.x, -unit.z}); }
    Vec2d locateUnit(std::uint32_t patch, const Vec3d& unit) const;

    /// Part of the patch's quarter turn at u, and back.
    double partOf(double u) const { return clockwise_ ? 1.0 - u : u; }

  private:
    double radiusAt(double v) const { return (1.0 - v) * first_.radius + v * last_.radius; }
    double heightAt(double v) const { return (1.0 - v) * first_.height + v * last_.height; }
    /// At a point (cos, sin) of the turn.
    Vec3d positionAt(const Vec2d& turn, double v) const;
    Arc arcBetween(std::uint32_t patch, double u0, double u1) const;
    /// Directions whose combinations are the normals over a part of the turn, of either side: they do not
    /// depend on v.
    std::array<Vec3d, 4> normalHull(const Arc& arc) const;
    Vec3d normalAlong(const Vec2d& turn) const;
    double measureAround(std::uint32_t patch, double from, double to) const;

    AffineMap map_;
    End first_;
    End last_;
    bool inside_;
    /// Whether u runs against the turn.
    bool clockwise_;
    Strips strips_;
};

}  // namespace fluxwalk::surface
