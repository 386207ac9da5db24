#pragma once

#include "core/surface/cone.h"

namespace fluxwalk::surface {

/// Cylinder without caps, about +Y and centred on it: the frustum of equal radii. The front is the outside.
class Cylinder final : public Cone {
  public:
    /// Sizes in local units, both above 0. `inside` turns the normals inwards.
    Cylinder(const base::Mat4d& worldFromLocal, double radius, double height, bool inside = false)
        : Cone(worldFromLocal, radius, radius, height, inside) {}

    std::string_view kind() const override { return "cylinder"; }
};

}  // namespace fluxwalk::surface
