#pragma once

#include <memory>
#include <vector>

#include "core/surface/projectable.h"

namespace fluxwalk::surface {

/// Coarse polygons whose corners lie on an object or near it: triangles (which repeat their last corner) and
/// quads, counter-clockwise seen from outside. Faces that meet share their vertices' indices.
struct Cage {
    std::vector<Vec3d> vertices;
    std::vector<std::array<std::uint32_t, 4>> faces;
};

/// How the points of a dense lattice over all patches came onto the object.
struct ProjectionCount {
    std::size_t points = 0;
    /// By a ray against the normals' direction: the object lies behind the planar face, as where it is
    /// hollow.
    std::size_t reversed = 0;
    /// No ray met the object within the capture radius: its nearest point was taken.
    std::size_t closest = 0;
    /// Left on the planar face, as nothing was in reach or the surface would have folded. The cage is too
    /// coarse there.
    std::size_t unsnapped = 0;
    /// Least cosine between the object's normal and the direction of projection, and least growth of the
    /// measure along it, relative to the planar face, over what rays brought onto the object. Near 0 the map
    /// is about to fold there.
    double leastCosine = 1.0;
    double leastGrowth = 1.0;
};

/// Any object that can meet a ray and give a normal, in the faces of a coarse cage (object-based subdivision:
/// Schaefer, section 1; ALGORITHMS 1.6).
///
/// The paper splits a polygon in its plane and sends each new vertex along the mean of its edge's end normals
/// onto the object, against that direction where the object is hollow. Done literally, a point would depend
/// on the whole recursion that leads to it, and there would be nothing to integrate over between the
/// vertices. Here each cage face carries the direction field that interpolates its corners' normals, and
/// (u,v) is projected from the planar face along it:
///   x(u,v) = p(u,v) + t d(u,v),   d = sum w_k n_k,   t of the nearest hit on either side.
/// The map is as smooth as the object. Its derivative follows from the hit's normal alone. On an edge of the
/// cage p and d depend on the edge's two ends only, taken in the order of their indices, so that neighbours
/// agree to the last bit. The first split of each edge is exactly the paper's. Later splits send their vertex
/// along the mean of the unit directions that brought the ends onto the object; on a sphere these are the
/// normals, and every vertex is the geodesic middle of its edge.
class ProjectedSurface final : public Surface {
  public:
    /// Moves the cage's corners onto the object, along the mean normal of their faces.
    ProjectedSurface(std::shared_ptr<const Projectable> object, Cage cage);

    /// Counted once, over 9 x 9 points a patch.
    const ProjectionCount& projectionCount() const { return count_; }
    const Cage& cage() const { return cage_; }
    const Projectable& object() const { return *object_; }

    std::string_view kind() const override { return "projected surface"; }
    std::uint32_t patchCount() const override { return static_cast<std::uint32_t>(cage_.faces.size()); }
    PatchDomain domain(std::uint32_t patch) const override;
    SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const override;
    Vec2d splitPoint(std::uint32_t patch, const Vec2d& a, const Vec2d& b) const override;
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const override;
    /// (u,v) of the planar face itself: each patch shows the whole picture.
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool isPlanar(std::uint32_t /*patch*/) const override { return false; }
    /// Denied only for the outside of a convex object: nothing else is certain.
    bool canSeeItself(std::uint32_t patch, bool back) const override;
    RegionBounds bounds(std::uint32_t patch, const Region& region) const override;
    /// Quadrature over the true surface. Down to a 64th of a patch the parts add up to their parent exactly.
    double area(std::uint32_t patch, const Region& region) const override;
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;
    Box bounds() const override { return object_->bounds(); }

  private:
    /// Point and direction over the planar face, with their derivatives.
    struct Chart {
        Vec3d point{};
        Vec3d direction{};
        std::array<Vec3d, 2> pointSlope{};
        std::array<Vec3d, 2> directionSlope{};
    };
    enum class Outcome : std::uint8_t { ray, closest, planar };
    struct Placed {
        ProjectedPoint at;
        Outcome outcome = Outcome::planar;
    };
    /// Parameter of a point in a face's (u,v), and t along its direction.
    struct Located {
        Vec2d uv{};
        double t = 0.0;
        bool converged = false;
    };
    struct Edge {
        std::uint32_t first = 0;   ///< vertex with the smaller index
        std::uint32_t second = 0;  ///< the other
        double s = 0.0;            ///< from first to second
    };

    bool isTriangle(std::uint32_t patch) const { return cage_.faces[patch][2] == cage_.faces[patch][3]; }
    void snapCorners();
    void countProjections();
    Chart chartAt(std::uint32_t patch, const Vec2d& uv) const;
    /// Edge `side` of the face (from corner `side` to the next) if uv lies on it exactly.
    std::optional<Edge> edgeAt(std::uint32_t patch, unsigned side, const Vec2d& uv) const;
    Vec2d onEdge(std::uint32_t patch, unsigned side, double s) const;
    Placed project(const Vec3d& point, const Vec3d& direction, double capture) const;
    Placed place(std::uint32_t patch, const Vec2d& uv, const Chart& chart) const;
    /// det(p_u + t d_u, p_v + t d_v, d): the measure across d, on the planar face (t = 0) or off it.
    static double spread(const Chart& chart, double t);
    Located locateIn(std::uint32_t patch, const Vec3d& position) const;
    std::optional<RegionBounds> boundByContinuation(std::uint32_t patch, const Region& region) const;
    RegionBounds boundByHull(std::uint32_t patch, const Region& region) const;
    RegionBounds boundByParts(std::uint32_t patch, const Region& region, unsigned levels) const;

    std::shared_ptr<const Projectable> object_;
    Cage cage_;
    /// By vertex of the cage.
    std::vector<Vec3d> normals_;
    /// By patch: longest edge in metres, how far the object may be from the planar face.
    std::vector<double> capture_;
    /// By patch: whether all lattice points came onto the object by a ray.
    std::vector<std::uint8_t> isSmooth_;
    std::vector<Box> boxes_;
    ProjectionCount count_;
};

}  // namespace fluxwalk::surface
