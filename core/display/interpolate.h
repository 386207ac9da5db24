#pragma once

#include <optional>

#include "core/display/display_mesh.h"

namespace fluxwalk::display {

/// Reads the irradiance that a viewer shows: linear within the triangle that covers the point.
class DisplayLookup {
  public:
    /// Keeps references to both.
    DisplayLookup(const surface::Surface& surface, const DisplayMeshes& meshes)
        : surface_(surface), meshes_(meshes) {}

    /// Lux at (u,v) of a patch, or nothing where that side of it is not displayed. Cost: a descent through
    /// the patch's splits.
    std::optional<Rgb> irradiance(std::uint32_t patch, bool back, const Vec2d& uv) const;

  private:
    const surface::Surface& surface_;
    const DisplayMeshes& meshes_;
};

}  // namespace fluxwalk::display
