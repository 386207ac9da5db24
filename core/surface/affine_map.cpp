#include "core/surface/affine_map.h"

#include <cmath>

#include "core/base/check.h"

namespace fluxwalk::surface {

AffineMap::AffineMap(const base::Mat4d& worldFromUnit)
    : linear(worldFromUnit),
      inverse(glm::inverse(linear)),
      normals(glm::transpose(inverse)),
      // Added last to every point: plus zero in it makes minus zeros plus, so that equal points are equal in
      // all bits.
      center(Vec3d(worldFromUnit[3]) + Vec3d(0.0)),
      volume(std::abs(glm::determinant(linear))),
      isMirror(glm::determinant(linear) < 0.0) {
    FLUXWALK_CHECK(std::isfinite(volume) && volume > 0.0);
    FLUXWALK_CHECK(std::isfinite(center.x) && std::isfinite(center.y) && std::isfinite(center.z));
}

double AffineMap::similarityScale() const {
    constexpr double kTolerance = 1e-12;
    const double scale = glm::length(linear[0]);
    const double skew = std::abs(glm::dot(linear[0], linear[1])) + std::abs(glm::dot(linear[1], linear[2])) +
                        std::abs(glm::dot(linear[2], linear[0]));
    const bool isSimilar = std::abs(glm::length(linear[1]) - scale) < kTolerance * scale &&
                           std::abs(glm::length(linear[2]) - scale) < kTolerance * scale &&
                           skew < kTolerance * scale * scale;
    return isSimilar ? scale : 0.0;
}

base::Mat4d scaledMap(const base::Mat4d& worldFromLocal, const Vec3d& scale) {
    base::Mat4d scaled = worldFromLocal;
    for (int axis = 0; axis < 3; ++axis) {
        scaled[axis] *= scale[axis];
    }
    return scaled;
}

}  // namespace fluxwalk::surface
