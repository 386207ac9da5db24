#pragma once

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// Point of an object with its unit normal, which points out of the object whatever side a ray came from.
struct ProjectedPoint {
    Vec3d position{};
    Vec3d normal{};
    /// Along the ray, in units of its direction; 0 where no ray was involved.
    double t = 0.0;
};

/// What an object must be able to do at the least so that it can be subdivided: meet a ray and give a normal
/// there (Schaefer, section 1). It needs no parameterisation. All functions may be called from many threads
/// at once.
class Projectable {
  public:
    virtual ~Projectable() = default;

    /// First point with t in (tNear, tFar), from either side; tNear may be negative. Never misses a crossing,
    /// however thin the object; accurate to 1e-10 of the object's size.
    virtual std::optional<ProjectedPoint> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                                    double tFar) const = 0;

    /// Point of the object nearest to `position`, for where no ray meets it. Default: not known.
    virtual std::optional<ProjectedPoint> closestPoint(const Vec3d& position) const;

    /// Bound in radians of the angle between the normal at `point`, which lies on the object, and the normals
    /// of all its points within `radius` metres. Must not be too small: bounds of elements rest on it. Pi
    /// where nothing is known.
    virtual double normalVariation(const Vec3d& point, double radius) const = 0;

    /// True where the object is the surface of a convex solid.
    virtual bool isConvex() const { return false; }

    virtual Box bounds() const = 0;
};

}  // namespace fluxwalk::surface
