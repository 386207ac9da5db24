#include "core/surface/sphere.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/surface/integrate_area.h"
#include "core/surface/turns.h"

namespace fluxwalk::surface {

namespace {

using base::kPi;

base::Mat4d similarity(const Vec3d& center, double radius) {
    base::Mat4d m(radius);
    m[3] = glm::dvec4(center, 1.0);
    return m;
}

// Solid angle of the spherical triangle with unit corners (Van Oosterom and Strackee 1983).
double solidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double triple = std::abs(glm::dot(a, glm::cross(b, c)));
    return 2.0 * std::atan2(triple, 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

}  // namespace

Sphere::Sphere(const base::Mat4d& worldFromUnit, bool inside)
    : linear_(worldFromUnit),
      inverse_(glm::inverse(linear_)),
      normalMatrix_(glm::transpose(inverse_)),
      center_(worldFromUnit[3]),
      determinant_(std::abs(glm::determinant(linear_))),
      radius_(0.0),
      inside_(inside),
      clockwise_(inside != (glm::determinant(linear_) < 0.0)) {
    const double r = glm::length(linear_[0]);
    const double skew = std::abs(glm::dot(linear_[0], linear_[1])) +
                        std::abs(glm::dot(linear_[1], linear_[2])) +
                        std::abs(glm::dot(linear_[2], linear_[0]));
    if (std::abs(glm::length(linear_[1]) - r) < 1e-9 * r &&
        std::abs(glm::length(linear_[2]) - r) < 1e-9 * r && skew < 1e-9 * r * r) {
        radius_ = r;
    }
    for (std::uint32_t patch = 0; patch < octants_.size(); ++patch) {
        octants_[patch] = makeOctant(patch);
    }
}

Sphere::Sphere(const Vec3d& center, double radius, bool inside)
    : Sphere(similarity(center, radius), inside) {}

base::Mat4d Sphere::worldFromUnit() const {
    base::Mat4d m(linear_);
    m[3] = glm::dvec4(center_, 1.0);
    return m;
}

Sphere::Octant Sphere::makeOctant(std::uint32_t patch) const {
    constexpr std::array<std::array<double, 2>, 4> kEquator{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};
    const std::uint32_t quarter = patch & 3u;
    const auto& a = kEquator[quarter];
    const auto& b = kEquator[(quarter + 1) & 3u];
    const Vec3d from(a[0], 0, a[1]);
    const Vec3d to(b[0], 0, b[1]);
    const bool north = patch < 4;
    const Vec3d pole(0, north ? 1 : -1, 0);
    return north != clockwise_ ? Octant{pole, from, to} : Octant{pole, to, from};
}

Vec3d Sphere::directionAt(std::uint32_t patch, const Vec2d& uv) const {
    const Octant& o = octant(patch);
    double w = 1.0 - uv.x - uv.y;
    if (std::abs(w) < 1e-15) {
        w = 0.0;  // on the equator, bitwise the same from both sides
    }
    return glm::normalize(w * o.pole + uv.x * o.first + uv.y * o.second);
}

Vec3d Sphere::normalAt(const Vec3d& unit) const {
    const Vec3d n = glm::normalize(normalMatrix_ * unit);
    return inside_ ? -n : n;
}

SurfacePoint Sphere::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    const Vec3d unit = directionAt(patch, uv);
    // Solid angle of the flat octant's measure: du dv / |P|^3, as the three axes span a unit volume.
    const double w = 1.0 - uv.x - uv.y;
    const double squared = w * w + uv.x * uv.x + uv.y * uv.y;
    const double solid = 1.0 / (squared * std::sqrt(squared));
    return {toWorld(unit), normalAt(unit), solid * determinant_ * glm::length(normalMatrix_ * unit)};
}

Vec2d Sphere::splitPoint(std::uint32_t patch, const Vec2d& a, const Vec2d& b) const {
    const Octant& o = octant(patch);
    const Vec3d middle = directionAt(patch, a) + directionAt(patch, b);
    const double w = std::abs(glm::dot(middle, o.pole));
    const double u = std::abs(glm::dot(middle, o.first));
    const double v = std::abs(glm::dot(middle, o.second));
    const double sum = w + (u + v);
    return {u / sum, v / sum};
}

Vec2d Sphere::locate(std::uint32_t patch, const Vec3d& position) const {
    const Octant& o = octant(patch);
    const Vec3d unit = inverse_ * (position - center_);
    const double w = std::max(0.0, glm::dot(unit, o.pole));
    const double u = std::max(0.0, glm::dot(unit, o.first));
    const double v = std::max(0.0, glm::dot(unit, o.second));
    const double sum = w + (u + v);
    return sum > 0.0 ? Vec2d(u / sum, v / sum) : Vec2d(1.0 / 3.0);
}

Vec2d Sphere::texcoord(std::uint32_t patch, const Vec2d& uv, unsigned /*set*/) const {
    const Octant& o = octant(patch);
    const Vec3d unit = directionAt(patch, uv);
    const bool eastward = (patch < 4) != clockwise_;
    // Longitude within the quarter, so that no patch sees the seam; at a pole the quarter's middle.
    const double along = glm::dot(unit, eastward ? o.first : o.second);
    const double across = glm::dot(unit, eastward ? o.second : o.first);
    const double quarter = along + across > 0.0 ? std::atan2(across, along) : 0.25 * kPi;
    const double longitude = 0.5 + (static_cast<double>(patch & 3u) * 0.5 * kPi + quarter) / (2.0 * kPi);
    return {patch % 4 >= 2 ? longitude - 1.0 : longitude, std::acos(std::clamp(unit.y, -1.0, 1.0)) / kPi};
}

bool Sphere::canSeeItself(std::uint32_t /*patch*/, bool back) const {
    return inside_ != back;
}

bool Sphere::normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const {
    std::array<Vec3d, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = directionAt(patch, region.corners[i]);
    }
    if (radius_ > 0.0) {
        const Vec3d axis = glm::normalize(corner[0] + corner[1] + corner[2]);
        const base::AngleLimit limit(halfAngle);
        return std::all_of(corner.begin(), corner.end(),
                           [&](const Vec3d& c) { return limit.holds(axis, c); });
    }
    for (Vec3d& c : corner) {
        c = normalAt(c);
    }
    return isWithinCone(corner, halfAngle);
}

RegionBounds Sphere::bounds(std::uint32_t patch, const Region& region) const {
    // Cap about the mean direction that holds the corners: it holds the spherical triangle too, as caps below
    // a hemisphere are convex.
    std::array<Vec3d, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = directionAt(patch, region.corners[i]);
    }
    const Vec3d axis = glm::normalize(corner[0] + corner[1] + corner[2]);
    double halfAngle = 0.0;
    for (const Vec3d& c : corner) {
        halfAngle = std::max(halfAngle, NormalCone::angleBetween(axis, c));
    }
    RegionBounds result;
    // Extent of the cap along each world axis: the support of a cap along l is |l| cos(max(0, angle -
    // halfAngle)).
    for (int i = 0; i < 3; ++i) {
        const Vec3d l(linear_[0][i], linear_[1][i], linear_[2][i]);
        const double scale = glm::length(l);
        const double angle = NormalCone::angleBetween(l / scale, axis);
        result.box.upper[i] = center_[i] + scale * std::cos(std::max(0.0, angle - halfAngle));
        result.box.lower[i] = center_[i] + scale * std::cos(std::min(kPi, angle + halfAngle));
    }
    if (radius_ > 0.0) {
        result.normals = {normalAt(axis), halfAngle};
        return result;
    }
    // Directions of the triangle are combinations of its corners', so its normals are of theirs.
    for (Vec3d& c : corner) {
        c = normalAt(c);
    }
    result.normals = coneAround(corner);
    return result;
}

double Sphere::area(std::uint32_t patch, const Region& region) const {
    if (radius_ > 0.0) {
        return radius_ * radius_ *
               solidAngle(directionAt(patch, region.corners[0]), directionAt(patch, region.corners[1]),
                          directionAt(patch, region.corners[2]));
    }
    return integrateArea(*this, patch, region);
}

std::optional<double> Sphere::exactKernel(bool back) const {
    if (radius_ > 0.0 && inside_ != back) {
        return 1.0 / (4.0 * kPi * radius_ * radius_);
    }
    return std::nullopt;
}

bool Sphere::isConvexAround(const Box& box) const {
    for (unsigned i = 0; i < 8; ++i) {
        const Vec3d corner((i & 1u) != 0 ? box.upper.x : box.lower.x,
                           (i & 2u) != 0 ? box.upper.y : box.lower.y,
                           (i & 4u) != 0 ? box.upper.z : box.lower.z);
        const Vec3d p = inverse_ * (corner - center_);
        if (glm::dot(p, p) > 1.0) {
            return false;
        }
    }
    return true;
}

std::optional<SurfaceHit> Sphere::intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                            double tFar) const {
    const Vec3d o = inverse_ * (origin - center_);
    const Vec3d d = inverse_ * direction;
    const double a = glm::dot(d, d);
    const double halfB = glm::dot(o, d);
    // Discriminant from the distance of the line to the centre: keeps its digits where the origin is far away
    // or on the sphere.
    const Vec3d foot = o - (halfB / a) * d;
    const double discriminant = a * (1.0 - glm::dot(foot, foot));
    if (!(discriminant >= 0.0)) {
        return std::nullopt;
    }
    const double c = glm::dot(o, o) - 1.0;
    const double q = -(halfB + std::copysign(std::sqrt(discriminant), halfB));
    double t0 = q / a;
    double t1 = q != 0.0 ? c / q : t0;
    if (t0 > t1) {
        std::swap(t0, t1);
    }
    for (const double t : {t0, t1}) {
        if (t > tNear && t < tFar) {
            const Vec3d unit = o + t * d;
            const std::uint32_t quarter =
                unit.x >= 0.0 ? (unit.z <= 0.0 ? 0u : 3u) : (unit.z <= 0.0 ? 1u : 2u);
            const std::uint32_t patch = quarter + (unit.y >= 0.0 ? 0u : 4u);
            return SurfaceHit{t, patch, locate(patch, toWorld(unit))};
        }
    }
    return std::nullopt;
}

Box Sphere::bounds() const {
    Box box;
    for (int i = 0; i < 3; ++i) {
        const double reach = glm::length(Vec3d(linear_[0][i], linear_[1][i], linear_[2][i]));
        box.lower[i] = center_[i] - reach;
        box.upper[i] = center_[i] + reach;
    }
    return box;
}

}  // namespace fluxwalk::surface
