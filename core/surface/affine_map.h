#pragma once

#include "core/surface/surface.h"

namespace fluxwalk::surface {

/// Takes a shape in the form its equations are simplest in ("unit") to its place in the world.
struct AffineMap {
    glm::dmat3 linear{1.0};
    glm::dmat3 inverse{1.0};
    /// Transposed inverse: takes normals to the world, where they need normalising.
    glm::dmat3 normals{1.0};
    Vec3d center{};
    /// Volume of the unit cube's image in m3.
    double volume = 1.0;
    bool isMirror = false;

    /// `worldFromUnit` is finite and not singular.
    explicit AffineMap(const base::Mat4d& worldFromUnit);

    Vec3d toWorld(const Vec3d& unit) const { return linear * unit + center; }
    Vec3d toUnit(const Vec3d& world) const { return inverse * (world - center); }
    /// World coordinate `axis` of the unit axes' images.
    Vec3d row(int axis) const { return {linear[0][axis], linear[1][axis], linear[2][axis]}; }
    /// The factor by which a similarity scales lengths; 0 for other maps.
    double similarityScale() const;
};

/// `worldFromLocal` after a scale along the local axes.
base::Mat4d scaledMap(const base::Mat4d& worldFromLocal, const Vec3d& scale);

}  // namespace fluxwalk::surface
