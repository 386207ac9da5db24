#pragma once

#include <optional>

#include "core/base/parallel.h"
#include "core/rays/spatial_tree.h"
#include "core/scene/lit_mesh.h"

namespace fluxwalk::bench {

using base::Rgb;
using base::Vec3d;

/// Reads a lit mesh as a viewer shows it: linear within the triangle under a point. Needs nothing but the
/// mesh's arrays.
class MeshLookup {
  public:
    /// `tolerance` in metres: how far a point of the exact surface may lie off its triangle.
    MeshLookup(const scene::LitMesh& mesh, double tolerance, const base::Executor& executor);

    /// Lux at the triangle that the line through `position` along `normal` meets nearby.
    std::optional<Rgb> irradiance(const Vec3d& position, const Vec3d& normal) const;

  private:
    const scene::LitMesh& mesh_;
    double tolerance_;
    rays::SpatialTree tree_;
};

}  // namespace fluxwalk::bench
