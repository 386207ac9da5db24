#include "core/surface/disk.h"

#include <cmath>

#include "core/base/check.h"

namespace fluxwalk::surface {

namespace {

/// How far past its rims a disk still stops rays, relative to its radius: the rounding of a hit.
constexpr double kRim = 1e-12;

base::Mat4d worldFromUnit(const base::Mat4d& worldFromLocal, double radius, double innerRadius) {
    FLUXWALK_CHECK(std::isfinite(radius) && radius > 0.0);
    FLUXWALK_CHECK(innerRadius >= 0.0 && innerRadius < radius);
    return scaledMap(worldFromLocal, Vec3d(radius));
}

}  // namespace

Disk::Disk(const base::Mat4d& worldFromLocal, double radius, double innerRadius, bool inside)
    : RevolvedSegment(worldFromUnit(worldFromLocal, radius, innerRadius), {1.0, 0.0},
                      {innerRadius / radius, 0.0}, inside),
      inner_(innerRadius / radius) {}

Vec2d Disk::texcoord(std::uint32_t patch, const Vec2d& uv, unsigned /*set*/) const {
    const double radius = (1.0 - uv.y) + uv.y * inner_;
    const Vec2d at = radius * turnAt(patch, partOf(uv.x));
    return {0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y};
}

std::optional<SurfaceHit> Disk::intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                          double tFar) const {
    const Vec3d o = map().toUnit(origin);
    const Vec3d d = map().inverse * direction;
    const double t = -o.y / d.y;
    if (!(t > tNear && t < tFar)) {
        return std::nullopt;
    }
    const Vec3d unit(o.x + t * d.x, 0.0, o.z + t * d.z);
    const double radius = std::hypot(unit.x, unit.z);
    if (!(radius <= 1.0 + kRim && radius >= inner_ - kRim)) {
        return std::nullopt;
    }
    const std::uint32_t patch = patchAt(unit);
    return SurfaceHit{t, patch, locateUnit(patch, unit)};
}

}  // namespace fluxwalk::surface
