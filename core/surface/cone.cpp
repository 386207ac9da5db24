#include "core/surface/cone.h"

#include <cmath>

#include "core/base/check.h"

namespace fluxwalk::surface {

namespace {

/// How far past its ends a surface still stops rays, relative to its height: the rounding of a hit. Without
/// it a ray could slip between a cylinder and the disk that closes it.
constexpr double kRim = 1e-12;

base::Mat4d worldFromUnit(const base::Mat4d& worldFromLocal, double radius, double height) {
    FLUXWALK_CHECK(std::isfinite(radius) && radius > 0.0);
    FLUXWALK_CHECK(std::isfinite(height) && height > 0.0);
    return scaledMap(worldFromLocal, {radius, height, radius});
}

// a b - c d with one rounding in place of a cancellation (Kahan).
double differenceOfProducts(double a, double b, double c, double d) {
    const double cd = c * d;
    return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

}  // namespace

Cone::Cone(const base::Mat4d& worldFromLocal, double radiusBottom, double radiusTop, double height,
           bool inside)
    : RevolvedSegment(worldFromUnit(worldFromLocal, std::max(radiusBottom, radiusTop), height),
                      {radiusBottom / std::max(radiusBottom, radiusTop), -0.5},
                      {radiusTop / std::max(radiusBottom, radiusTop), 0.5}, inside),
      growth_((radiusTop - radiusBottom) / std::max(radiusBottom, radiusTop)),
      focusRadius_(0.5 * (radiusBottom + radiusTop) / std::max(radiusBottom, radiusTop)) {
    if (std::abs(growth_) > focusRadius_) {
        focus_ = -focusRadius_ / growth_;
        focusRadius_ = 0.0;
    }
}

bool Cone::isConvexAround(const Box& box) const {
    // Where the cone's radius is not negative its inside is convex, above and below the frustum too.
    const auto isInside = [this](const Vec3d& corner) {
        const Vec3d p = map().toUnit(corner);
        const double radius = focusRadius_ + growth_ * (p.y - focus_);
        return radius >= 0.0 && p.x * p.x + p.z * p.z <= radius * radius;
    };
    for (unsigned i = 0; i < 8; ++i) {
        if (!isInside({(i & 1u) != 0 ? box.upper.x : box.lower.x, (i & 2u) != 0 ? box.upper.y : box.lower.y,
                       (i & 4u) != 0 ? box.upper.z : box.lower.z})) {
            return false;
        }
    }
    return true;
}

std::optional<SurfaceHit> Cone::intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                          double tFar) const {
    const Vec3d d = map().inverse * direction;
    Vec3d p = map().toUnit(origin);
    p.y -= focus_;
    // Measured from the ray's point nearest to the apex or the middle, coefficients stay small where the hit
    // is: far origins and rays past the apex keep their digits.
    const double nearest = -glm::dot(p, d) / glm::dot(d, d);
    p += nearest * d;
    // x^2 + z^2 = (radius + growth y)^2 along the ray: a s^2 + 2 b s + c = 0.
    const double slope = growth_ * d.y;
    const double radius = focusRadius_ + growth_ * p.y;
    const double flat = std::hypot(p.x, p.z);
    const double a = d.x * d.x + d.z * d.z - slope * slope;
    const double b = p.x * d.x + p.z * d.z - slope * radius;
    const double c = (flat - radius) * (flat + radius);
    const double discriminant = differenceOfProducts(b, b, a, c);
    if (!(discriminant >= 0.0)) {
        return std::nullopt;
    }
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    // Along a generator a is 0 and the first is infinite or undefined, which no range holds.
    double s0 = q / a;
    double s1 = c / q;
    if (!(s0 <= s1)) {
        std::swap(s0, s1);
    }
    for (const double s : {s0, s1}) {
        const double t = nearest + s;
        if (!(t > tNear && t < tFar)) {
            continue;
        }
        Vec3d unit = p + s * d;
        unit.y += focus_;
        // Within the height the radius is positive: the other nappe's hits are outside it.
        if (std::abs(unit.y) <= 0.5 + kRim) {
            const std::uint32_t patch = patchAt(unit);
            return SurfaceHit{t, patch, locateUnit(patch, unit)};
        }
    }
    return std::nullopt;
}

}  // namespace fluxwalk::surface
