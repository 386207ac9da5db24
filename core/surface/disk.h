#pragma once

#include "core/surface/revolved_segment.h"

namespace fluxwalk::surface {

/// Disk or annulus that faces +Y, centred, in four polar patches whose v runs from the rim inwards.
class Disk final : public RevolvedSegment {
  public:
    /// Radii in local units, 0 <= innerRadius < radius. `inside` makes it face -Y.
    explicit Disk(const base::Mat4d& worldFromLocal, double radius, double innerRadius = 0.0,
                  bool inside = false);

    std::string_view kind() const override { return "disk"; }
    /// The unit square about the circle as seen from +Y with -Z up, as Blender unwraps a circle.
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool canSeeItself(std::uint32_t /*patch*/, bool /*back*/) const override { return false; }
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;

  private:
    /// Inner radius where the outer one is 1.
    double inner_;
};

}  // namespace fluxwalk::surface
