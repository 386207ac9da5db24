#pragma once

#include <vector>

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// Input of PolygonMesh: indexed triangles, counter-clockwise seen from the front, with up to two texture
/// coordinate sets.
struct TriangleSoup {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// One coordinate per position, or empty.
    std::array<std::vector<base::Vec2>, 2> texcoords;
};

/// Whether four points lie in one plane up to the rounding of float input, as the corners of one quad have
/// to.
bool isCoplanar(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// Planar polygons. Pairs of coplanar triangles that make a convex quad (with one affine texture map) are one
/// patch.
class PolygonMesh final : public Surface {
  public:
    /// Drops triangles without area. Indices must be in range and positions finite (the readers check).
    explicit PolygonMesh(TriangleSoup soup);

    std::size_t droppedTriangleCount() const { return dropped_; }
    /// World positions of a patch's 3 or 4 corners.
    std::array<Vec3d, 4> corners(std::uint32_t patch) const;
    std::uint32_t cornerCount(std::uint32_t patch) const;

    std::string_view kind() const override { return "polygon mesh"; }
    std::uint32_t patchCount() const override { return static_cast<std::uint32_t>(patches_.size()); }
    PatchDomain domain(std::uint32_t patch) const override;
    SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const override;
    Strips strips(std::uint32_t patch) const override;
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const override;
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool isPlanar(std::uint32_t patch) const override;
    bool canSeeItself(std::uint32_t patch, bool back) const override;
    RegionBounds bounds(std::uint32_t patch, const Region& region) const override;
    double area(std::uint32_t patch, const Region& region) const override;
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;
    TriangleView triangles() const override;
    Box bounds() const override { return box_; }

  private:
    Vec3d position(std::uint32_t patch, const Vec2d& uv) const;

    std::vector<Vec3> positions_;
    std::array<std::vector<base::Vec2>, 2> texcoords_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> patchOfTriangle_;
    /// Corner indices; a triangle repeats its last one.
    std::vector<std::array<std::uint32_t, 4>> patches_;
    Box box_;
    std::size_t dropped_ = 0;
};

}  // namespace fluxwalk::surface
