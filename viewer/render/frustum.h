#pragma once

#include <array>

#include "core/base/bounds.h"

namespace fluxwalk::render {

/// The part of space that a picture shows, from its matrix (world to GL clip space).
class Frustum {
  public:
    explicit Frustum(const glm::mat4& clipFromWorld);

    /// Whether a box lies wholly behind one of the six planes; some boxes that are not seen pass.
    bool isOutside(const base::Box& box) const;

  private:
    /// Inside where dot(xyz, p) + w >= 0.
    std::array<glm::dvec4, 6> planes_;
};

/// Distance in metres from a point to the nearest point of a box, 0 within it.
double distanceTo(const base::Box& box, const base::Vec3d& point);

}  // namespace fluxwalk::render
