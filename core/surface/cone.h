#pragma once

#include "core/surface/revolved_segment.h"

namespace fluxwalk::surface {

/// Cone or frustum without caps, about +Y and centred on it. The front is the outside.
class Cone : public RevolvedSegment {
  public:
    /// Sizes in local units: `height` above 0, the radii at -height/2 and +height/2 at least 0 and not both
    /// 0. `inside` turns the normals inwards.
    Cone(const base::Mat4d& worldFromLocal, double radiusBottom, double radiusTop, double height,
         bool inside = false);

    std::string_view kind() const override { return "cone"; }
    bool isConvexAround(const Box& box) const override;
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;

  private:
    /// Growth of the radius from the bottom to the top of the unit form, whose larger radius is 1 and whose
    /// height is 1.
    double growth_;
    /// Height that rays are measured from, and the radius there: the apex where it is near.
    double focus_ = 0.0;
    double focusRadius_;
};

}  // namespace fluxwalk::surface
