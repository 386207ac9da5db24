#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/bounds.h"
#include "core/base/normal_cone.h"
#include "core/base/vec.h"

/// Exact shapes. Everything is in world space, metres; normals point to the front side.
namespace fluxwalk::surface {

using base::Box;
using base::NormalCone;
using base::Vec2d;
using base::Vec3;
using base::Vec3d;

/// Parameter domain of a patch: the unit square, or the triangle u >= 0, v >= 0, u + v <= 1.
enum class PatchDomain : std::uint8_t { quad, triangle };

/// Part of a patch's domain: a polygon with 3 or 4 corners (u,v), counter-clockwise seen from the front.
struct Region {
    std::array<Vec2d, 4> corners{};
    std::uint32_t cornerCount = 4;
};

/// Point of a surface. `jacobian` is the area measure dA / (du dv) in m2.
struct SurfacePoint {
    Vec3d position{};
    Vec3d normal{};
    double jacobian = 0.0;
};

/// How a quad patch that is much longer than wide is cut: at some levels into four strips across its length,
/// which are nearer to squares than quarters of it would be.
struct Strips {
    std::uint8_t from = 0;    ///< level of the first split of this kind; those above it make quarters
    std::uint8_t levels = 0;  ///< splits of this kind
    bool alongV = false;      ///< strips follow each other along v, else along u
};

/// What bounds a region: a box and a cone that hold all its points and normals.
struct RegionBounds {
    Box box;
    NormalCone normals;
};

/// Where a ray meets a surface. `t` is in units of the ray's direction.
struct SurfaceHit {
    double t = 0.0;
    std::uint32_t patch = 0;
    Vec2d uv{};
};

/// A surface's exact triangles, for surfaces that consist of them; empty spans otherwise.
struct TriangleView {
    std::span<const Vec3> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
    /// Patch of each triangle.
    std::span<const std::uint32_t> patches;
};

/// One exact shape, cut into its coarsest patches. Subdivision, form factors and rays ask nothing else of a
/// shape. (Schaefer, section 1: an object is what can meet a ray and give a normal; a parameterisation makes
/// it cheaper.)
class Surface {
  public:
    virtual ~Surface() = default;

    /// What it is, in the words of the design ("sphere", "polygon mesh").
    virtual std::string_view kind() const { return "surface"; }

    virtual std::uint32_t patchCount() const = 0;
    virtual PatchDomain domain(std::uint32_t patch) const = 0;

    /// Point, front normal and area measure at (u,v) of a patch. Neighbouring patches give bitwise equal
    /// positions on their common edge at corresponding parameters.
    virtual SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const = 0;

    /// Parameter at which an edge between two parameters is split; symmetric in its ends. Default: the
    /// middle.
    virtual Vec2d splitPoint(std::uint32_t patch, const Vec2d& a, const Vec2d& b) const;

    /// Elements of surfaces whose points depend on how they were split are quartered only, which is the
    /// default.
    virtual Strips strips(std::uint32_t patch) const;

    /// Parameter of the point of `patch` nearest to `position`, which lies on or near it.
    virtual Vec2d locate(std::uint32_t patch, const Vec3d& position) const = 0;

    /// Texture coordinate (glTF: v downwards) of set 0 or 1 at (u,v).
    virtual Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const = 0;

    /// True where every region of the patch is a planar polygon whose edges are straight.
    virtual bool isPlanar(std::uint32_t patch) const = 0;

    /// Whether two points of this patch can see each other on the given side.
    virtual bool canSeeItself(std::uint32_t patch, bool back) const = 0;

    virtual RegionBounds bounds(std::uint32_t patch, const Region& region) const = 0;

    /// Whether the cone in a region's bounds is no wider than `halfAngle` (radians). Default: makes the
    /// bounds; surfaces override it where less tells that.
    virtual bool normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const;

    /// True area of a region in m2. Default: Gauss quadrature of the area measure.
    virtual double area(std::uint32_t patch, const Region& region) const;

    /// The kernel cos cos / (pi r2) in 1/m2 between any two points on the given side, where it is one
    /// constant (inside of a sphere: 1 / (4 pi R2)).
    virtual std::optional<double> exactKernel(bool back) const;

    /// Whether all points of the box lie inside the surface, and that inside is convex: then no line between
    /// two of them, or from one to a point of the surface's hollow side, or between two such points, meets
    /// the surface on its way. Default: never.
    virtual bool isConvexAround(const Box& box) const;

    /// First intersection with t in (tNear, tFar), for surfaces without triangles.
    virtual std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                                double tFar) const = 0;

    virtual TriangleView triangles() const;

    virtual Box bounds() const = 0;
};

}  // namespace fluxwalk::surface
