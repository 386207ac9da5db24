#include "core/surface/torus.h"

#include <cmath>

#include "core/base/check.h"
#include "core/surface/integrate_area.h"
#include "core/surface/strips.h"
#include "core/surface/torus_roots.h"

namespace fluxwalk::surface {

namespace {

using base::kPi;

constexpr double kQuarter = 0.5 * kPi;

base::Mat4d worldFromUnit(const base::Mat4d& worldFromLocal, double majorRadius, double minorRadius) {
    FLUXWALK_CHECK(std::isfinite(majorRadius));
    FLUXWALK_CHECK(minorRadius > 0.0 && minorRadius <= majorRadius);
    return scaledMap(worldFromLocal, Vec3d(majorRadius));
}

}  // namespace

Torus::Torus(const base::Mat4d& worldFromLocal, double majorRadius, double minorRadius, bool inside)
    : map_(worldFromUnit(worldFromLocal, majorRadius, minorRadius)),
      tube_(minorRadius / majorRadius),
      scale_(map_.similarityScale()),
      inside_(inside),
      clockwise_(inside != map_.isMirror) {
    // All patches alike, so that strips meet: as long as a patch about the ring's centre line.
    strips_ = measureStrips([this](const Vec2d& uv) {
        const Vec2d ring = turnAt(0, partOf(uv.x));
        const Vec2d tube = turnAt(0, uv.y);
        const double radius = 1.0 + tube_ * (tube.x - 0.5);
        return map_.toWorld({radius * ring.x, tube_ * tube.y, -radius * ring.y});
    });
}

Arc Torus::ringArc(std::uint32_t patch, double u0, double u1) const {
    const double from = partOf(u0);
    const double to = partOf(u1);
    return {patch & 3u, std::min(from, to), std::max(from, to)};
}

SurfacePoint Torus::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    const Vec2d ring = turnAt(patch & 3u, partOf(uv.x));
    const Vec2d tube = turnAt(patch >> 2, uv.y);
    const double radius = 1.0 + tube_ * tube.x;
    const Vec3d outward = map_.normals * Vec3d(tube.x * ring.x, tube.y, -tube.x * ring.y);
    const double stretch = glm::length(outward);
    return {map_.toWorld({radius * ring.x, tube_ * tube.y, -radius * ring.y}),
            (inside_ ? -outward : outward) / stretch,
            kQuarter * kQuarter * radius * tube_ * map_.volume * stretch};
}

Vec2d Torus::locateUnit(std::uint32_t patch, const Vec3d& unit) const {
    const Vec2d tube(std::hypot(unit.x, unit.z) - 1.0, unit.y);
    return {partOf(partOfQuarter(patch & 3u, {unit.x, -unit.z})), partOfQuarter(patch >> 2, tube)};
}

Vec2d Torus::locate(std::uint32_t patch, const Vec3d& position) const {
    return locateUnit(patch, map_.toUnit(position));
}

Vec2d Torus::texcoord(std::uint32_t patch, const Vec2d& uv, unsigned /*set*/) const {
    const std::uint32_t ring = patch & 3u;
    const std::uint32_t tube = patch >> 2;
    const double around = 0.5 + 0.25 * (static_cast<double>(ring) + partOf(uv.x));
    const double upwards = 0.5 + 0.25 * (static_cast<double>(tube) + uv.y);
    return {ring >= 2 ? around - 1.0 : around, 1.0 - (tube >= 2 ? upwards - 1.0 : upwards)};
}

bool Torus::canSeeItself(std::uint32_t patch, bool back) const {
    const std::uint32_t tube = patch >> 2;
    const bool isInnerHalf = tube == 1 || tube == 2;
    return inside_ != back || isInnerHalf;
}

// Normals are linear in (cos, sin) of either angle: the products of both hulls hold them.
std::array<Vec3d, 16> Torus::normalHull(const Arc& ring, const Arc& tube) const {
    const std::array<Vec2d, 4> around = hullOf(ring);
    std::array<Vec3d, 16> normals{};
    std::size_t count = 0;
    for (const Vec2d& t : hullOf(tube)) {
        for (const Vec2d& r : around) {
            normals[count++] = map_.normals * Vec3d(t.x * r.x, t.y, -t.x * r.y);
        }
    }
    return normals;
}

RegionBounds Torus::bounds(std::uint32_t patch, const Region& region) const {
    const auto [lower, upper] = parameterBox(region);
    const Arc ring = ringArc(patch, lower.x, upper.x);
    const Arc tube{patch >> 2, lower.y, upper.y};
    RegionBounds result;
    for (int axis = 0; axis < 3; ++axis) {
        // A world coordinate is (1 + tube cos) g + tube sin h with g from the ring alone; as the bracket is
        // not negative, the extremes lie at those of g.
        const Vec3d row = map_.row(axis);
        const Interval g = rangeOver(ring, {row.x, -row.z});
        result.box.lower[axis] =
            map_.center[axis] + g.lower + tube_ * rangeOver(tube, {g.lower, row.y}).lower;
        result.box.upper[axis] =
            map_.center[axis] + g.upper + tube_ * rangeOver(tube, {g.upper, row.y}).upper;
    }
    result.normals = coneAround(normalHull(ring, tube));
    if (inside_) {
        result.normals.axis = -result.normals.axis;
    }
    return result;
}

bool Torus::normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const {
    const auto [lower, upper] = parameterBox(region);
    const Arc ring = ringArc(patch, lower.x, upper.x);
    return isWithinCone(normalHull(ring, {patch >> 2, lower.y, upper.y}), halfAngle);
}

double Torus::area(std::uint32_t patch, const Region& region) const {
    if (scale_ == 0.0 || !isParameterBox(region)) {
        return integrateArea(*this, patch, region);
    }
    const auto [lower, upper] = parameterBox(region);
    // Integral of (1 + tube cos), the difference of sines as a product.
    const double from = kQuarter * (static_cast<double>(patch >> 2) + lower.y);
    const double to = kQuarter * (static_cast<double>(patch >> 2) + upper.y);
    const double sines = 2.0 * std::cos(0.5 * (from + to)) * std::sin(0.5 * (to - from));
    return scale_ * scale_ * kQuarter * (upper.x - lower.x) * tube_ * ((to - from) + tube_ * sines);
}

std::optional<SurfaceHit> Torus::intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                           double tFar) const {
    const Vec3d d = map_.inverse * direction;
    const Vec3d o = map_.toUnit(origin);
    const double length = glm::length(d);
    const Vec3d along = d / length;
    // From the ray's point nearest to the centre; twice, as the first foot of a far origin is rounded.
    double nearest = -glm::dot(o, along);
    Vec3d foot = o + nearest * along;
    const double rest = -glm::dot(foot, along);
    nearest += rest;
    foot += rest * along;
    for (const double s :
         torusCrossings(tube_, foot, along, tNear * length - nearest, tFar * length - nearest)) {
        const double t = (nearest + s) / length;
        if (t > tNear && t < tFar) {
            const Vec3d unit = foot + s * along;
            const std::uint32_t ring = quarterOf({unit.x, -unit.z});
            const std::uint32_t tube = quarterOf({std::hypot(unit.x, unit.z) - 1.0, unit.y});
            const std::uint32_t patch = 4 * tube + ring;
            return SurfaceHit{t, patch, locateUnit(patch, unit)};
        }
    }
    return std::nullopt;
}

Box Torus::bounds() const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d row = map_.row(axis);
        const double ring = std::hypot(row.x, row.z);
        const double reach = ring + tube_ * std::hypot(ring, row.y);
        box.lower[axis] = map_.center[axis] - reach;
        box.upper[axis] = map_.center[axis] + reach;
    }
    return box;
}

}  // namespace fluxwalk::surface
