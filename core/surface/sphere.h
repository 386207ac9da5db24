#pragma once

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// A sphere under any affine map (so an ellipsoid too), in eight patches: the octants, each a triangle that
/// is projected onto the sphere from its centre. Edges split at their geodesic middle.
class Sphere final : public Surface {
  public:
    /// `worldFromUnit` takes the unit sphere about the origin (poles on +-Y) to its place. `inside` turns the
    /// normals inwards.
    explicit Sphere(const base::Mat4d& worldFromUnit, bool inside = false);
    Sphere(const Vec3d& center, double radius, bool inside = false);

    std::string_view kind() const override { return "sphere"; }
    std::uint32_t patchCount() const override { return 8; }
    PatchDomain domain(std::uint32_t /*patch*/) const override { return PatchDomain::triangle; }
    SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const override;
    Vec2d splitPoint(std::uint32_t patch, const Vec2d& a, const Vec2d& b) const override;
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const override;
    /// Longitude and latitude as on Blender's UV sphere, seam at -X.
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool isPlanar(std::uint32_t /*patch*/) const override { return false; }
    bool canSeeItself(std::uint32_t patch, bool back) const override;
    RegionBounds bounds(std::uint32_t patch, const Region& region) const override;
    bool normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const override;
    double area(std::uint32_t patch, const Region& region) const override;
    std::optional<double> exactKernel(bool back) const override;
    bool isConvexAround(const Box& box) const override;
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;
    Box bounds() const override;

    /// What takes the unit sphere to its place.
    base::Mat4d worldFromUnit() const;
    bool isInside() const { return inside_; }

  private:
    /// Axes of an octant, counter-clockwise seen from the front. Patches 0..3 are north, 4..7 south; within
    /// each half the octants follow the longitude from +X over -Z, as texture coordinates do.
    struct Octant {
        Vec3d pole;
        Vec3d first;
        Vec3d second;
    };
    Octant makeOctant(std::uint32_t patch) const;
    const Octant& octant(std::uint32_t patch) const { return octants_[patch]; }
    Vec3d directionAt(std::uint32_t patch, const Vec2d& uv) const;
    Vec3d toWorld(const Vec3d& unit) const { return linear_ * unit + center_; }
    Vec3d normalAt(const Vec3d& unit) const;

    glm::dmat3 linear_;
    glm::dmat3 inverse_;
    glm::dmat3 normalMatrix_;
    Vec3d center_;
    double determinant_;
    /// Radius where the map is a similarity, 0 otherwise.
    double radius_;
    bool inside_;
    /// Whether the octants' natural order runs clockwise seen from the front: inside, or under a mirror.
    bool clockwise_;
    std::array<Octant, 8> octants_;
};

}  // namespace fluxwalk::surface
