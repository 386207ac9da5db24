#include "core/surface/revolved_segment.h"

#include <cmath>

#include "core/base/check.h"
#include "core/surface/integrate_area.h"
#include "core/surface/strips.h"

namespace fluxwalk::surface {

namespace {

using base::kPi;

/// Nodes in [0, 1] and weights of Gauss-Legendre quadrature with 8 points.
constexpr std::array<double, 8> kNodes{0.01985507175123188, 0.10166676129318664, 0.2372337950418355,
                                       0.4082826787521751,  0.5917173212478249,  0.7627662049581645,
                                       0.8983332387068134,  0.9801449282487682};
constexpr std::array<double, 8> kWeights{0.05061426814518813, 0.11119051722668724, 0.15685332293894363,
                                         0.18134189168918100, 0.18134189168918100, 0.15685332293894363,
                                         0.11119051722668724, 0.05061426814518813};

template <class Function>
double integrateOnce(const Function& f, double from, double to) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        sum += kWeights[i] * f(from + kNodes[i] * (to - from));
    }
    return sum * (to - from);
}

// Halves the interval until that changes nothing.
template <class Function>
double integrate(const Function& f, double from, double to, double once, int depth) {
    constexpr double kTolerance = 1e-14;
    constexpr int kDeepest = 16;
    const double middle = 0.5 * (from + to);
    const double left = integrateOnce(f, from, middle);
    const double right = integrateOnce(f, middle, to);
    if (depth == kDeepest || std::abs(left + right - once) <= kTolerance * std::abs(once)) {
        return left + right;
    }
    return integrate(f, from, middle, left, depth + 1) + integrate(f, middle, to, right, depth + 1);
}

}  // namespace

RevolvedSegment::RevolvedSegment(const base::Mat4d& worldFromUnit, const End& first, const End& last,
                                 bool inside)
    : map_(worldFromUnit), first_(first), last_(last), inside_(inside), clockwise_(inside != map_.isMirror) {
    FLUXWALK_CHECK(first.radius >= 0.0 && last.radius >= 0.0);
    FLUXWALK_CHECK(first.radius + last.radius > 0.0);
    FLUXWALK_CHECK(first.radius != last.radius || first.height != last.height);
    // The first patch stands for all, so that strips meet around the axis.
    strips_ = measureStrips([this](const Vec2d& uv) { return positionAt(turnAt(0, partOf(uv.x)), uv.y); });
}

Vec3d RevolvedSegment::positionAt(const Vec2d& turn, double v) const {
    const double radius = radiusAt(v);
    return map_.toWorld({radius * turn.x, heightAt(v), -radius * turn.y});
}

// Outward normal on the line at a turn, in the world, as long as the area measure of the unit form at radius
// 1 grows by the map.
Vec3d RevolvedSegment::normalAlong(const Vec2d& turn) const {
    const double rise = last_.height - first_.height;
    const double spread = last_.radius - first_.radius;
    return map_.normals * Vec3d(rise * turn.x, -spread, -rise * turn.y);
}

SurfacePoint RevolvedSegment::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    const Vec2d turn = turnAt(patch, partOf(uv.x));
    const Vec3d outward = normalAlong(turn);
    const double stretch = glm::length(outward);
    return {positionAt(turn, uv.y), (inside_ ? -outward : outward) / stretch,
            0.5 * kPi * radiusAt(uv.y) * map_.volume * stretch};
}

Vec2d RevolvedSegment::locateUnit(std::uint32_t patch, const Vec3d& unit) const {
    const double rise = last_.height - first_.height;
    const double spread = last_.radius - first_.radius;
    const double v =
        ((std::hypot(unit.x, unit.z) - first_.radius) * spread + (unit.y - first_.height) * rise) /
        (spread * spread + rise * rise);
    return {partOf(partOfQuarter(patch, {unit.x, -unit.z})), std::clamp(v, 0.0, 1.0)};
}

Vec2d RevolvedSegment::locate(std::uint32_t patch, const Vec3d& position) const {
    return locateUnit(patch, map_.toUnit(position));
}

Vec2d RevolvedSegment::texcoord(std::uint32_t patch, const Vec2d& uv, unsigned /*set*/) const {
    const double around = 0.5 + 0.25 * (static_cast<double>(patch) + partOf(uv.x));
    return {patch >= 2 ? around - 1.0 : around, 1.0 - uv.y};
}

bool RevolvedSegment::canSeeItself(std::uint32_t /*patch*/, bool back) const {
    return inside_ != back;
}

Arc RevolvedSegment::arcBetween(std::uint32_t patch, double u0, double u1) const {
    const double from = partOf(u0);
    const double to = partOf(u1);
    return {patch, std::min(from, to), std::max(from, to)};
}

// Linear in (cos, sin).
std::array<Vec3d, 4> RevolvedSegment::normalHull(const Arc& arc) const {
    std::array<Vec3d, 4> normals{};
    const std::array<Vec2d, 4> turns = hullOf(arc);
    for (std::size_t i = 0; i < turns.size(); ++i) {
        normals[i] = normalAlong(turns[i]);
    }
    return normals;
}

RegionBounds RevolvedSegment::bounds(std::uint32_t patch, const Region& region) const {
    const auto [lower, upper] = parameterBox(region);
    const Arc arc = arcBetween(patch, lower.x, upper.x);
    RegionBounds result;
    for (int axis = 0; axis < 3; ++axis) {
        // At one turn the world's coordinates are linear in v, so their extremes lie at its ends.
        const Vec3d row = map_.row(axis);
        const Interval around = rangeOver(arc, {row.x, -row.z});
        for (const double v : {lower.y, upper.y}) {
            const double base = map_.center[axis] + row.y * heightAt(v);
            result.box.lower[axis] = std::min(result.box.lower[axis], base + radiusAt(v) * around.lower);
            result.box.upper[axis] = std::max(result.box.upper[axis], base + radiusAt(v) * around.upper);
        }
    }
    result.normals = coneAround(normalHull(arc));
    if (inside_) {
        result.normals.axis = -result.normals.axis;
    }
    return result;
}

bool RevolvedSegment::normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const {
    const auto [lower, upper] = parameterBox(region);
    return isWithinCone(normalHull(arcBetween(patch, lower.x, upper.x)), halfAngle);
}

// Integral over u of the area measure at radius 1.
double RevolvedSegment::measureAround(std::uint32_t patch, double from, double to) const {
    const auto measure = [&](double u) { return glm::length(normalAlong(turnAt(patch, partOf(u)))); };
    return 0.5 * kPi * map_.volume * integrate(measure, from, to, integrateOnce(measure, from, to), 0);
}

double RevolvedSegment::area(std::uint32_t patch, const Region& region) const {
    if (!isParameterBox(region)) {
        return integrateArea(*this, patch, region);
    }
    // The measure is the radius, linear in v, times a function of u.
    const auto [lower, upper] = parameterBox(region);
    return measureAround(patch, lower.x, upper.x) * (upper.y - lower.y) * radiusAt(0.5 * (lower.y + upper.y));
}

Box RevolvedSegment::bounds() const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d row = map_.row(axis);
        const double reach = std::hypot(row.x, row.z);
        for (const End& end : {first_, last_}) {
            const double base = map_.center[axis] + row.y * end.height;
            box.lower[axis] = std::min(box.lower[axis], base - end.radius * reach);
            box.upper[axis] = std::max(box.upper[axis], base + end.radius * reach);
        }
    }
    return box;
}

}  // namespace fluxwalk::surface
