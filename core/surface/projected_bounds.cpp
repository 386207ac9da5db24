#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/surface/projected_surface.h"
#include "core/surface/region.h"

// Boxes and cones of a surface that is only known point by point: they hold every point because the object
// bounds how fast its normals turn.
namespace fluxwalk::surface {

namespace {

/// Beyond 85 degrees between normal and direction a proof would bound nothing.
constexpr double kSteepest = 1.4835298641951802;
/// How often a region is quartered before its bounds are taken from the planar face.
constexpr unsigned kPartLevels = 3;

/// Points of (u,v) between which the chart over a region lies: the corners of a triangle, on which it is
/// linear; for quads, where it is linear in u and in v only, those of the box about the region.
std::array<Vec2d, 4> hullOf(const Region& region) {
    if (region.cornerCount == 3) {
        return {region.corners[0], region.corners[1], region.corners[2], region.corners[2]};
    }
    Vec2d lower = region.corners[0];
    Vec2d upper = region.corners[0];
    for (std::uint32_t k = 1; k < region.cornerCount; ++k) {
        lower = glm::min(lower, region.corners[k]);
        upper = glm::max(upper, region.corners[k]);
    }
    return {lower, Vec2d(upper.x, lower.y), upper, Vec2d(lower.x, upper.y)};
}

}  // namespace

// Along the straight way in (u,v) from the region's centre to any of its points, x moves by p' + t d',
// projected onto the tangent plane along d: at most |p' + t d'| / cos(n, d). If the object's normals stay
// clear of d's horizon within a ball about the centre, and the whole way is shorter than the ball's radius,
// then no point ever leaves the ball.
std::optional<RegionBounds> ProjectedSurface::boundByContinuation(std::uint32_t patch,
                                                                  const Region& region) const {
    Vec2d middle(0.0);
    for (std::uint32_t k = 0; k < region.cornerCount; ++k) {
        middle += region.corners[k] / static_cast<double>(region.cornerCount);
    }
    const Chart chart = chartAt(patch, middle);
    const Placed center = place(patch, middle, chart);
    if (center.outcome != Outcome::ray) {
        return std::nullopt;
    }
    const Vec3d& n = center.at.normal;
    const double t = center.at.t;
    const Vec3d axis = glm::normalize(chart.direction);
    double pointWay = 0.0;      // longest way of p + t d, t as at the centre
    double directionWay = 0.0;  // longest way of d alone
    double shortest = glm::length(chart.direction);
    double turn = 0.0;
    for (const Vec2d& at : hullOf(region)) {
        const Chart c = chartAt(patch, at);
        shortest = std::min(shortest, glm::dot(c.direction, axis));
        turn = std::max(turn, NormalCone::angleBetween(glm::normalize(c.direction), axis));
        for (std::uint32_t k = 0; k < region.cornerCount; ++k) {
            const Vec2d way = region.corners[k] - middle;
            const Vec3d d = way.x * c.directionSlope[0] + way.y * c.directionSlope[1];
            const Vec3d p = way.x * c.pointSlope[0] + way.y * c.pointSlope[1];
            pointWay = std::max(pointWay, glm::length(p + t * d));
            directionWay = std::max(directionWay, glm::length(d));
        }
    }
    const double slope = NormalCone::angleBetween(n, axis) + turn;
    if (shortest <= 0.0) {
        return std::nullopt;
    }
    double radius = 1.05 * pointWay;
    for (int round = 0; round < 12; ++round) {
        const double variation = object_->normalVariation(center.at.position, radius);
        if (variation + slope >= kSteepest) {
            return std::nullopt;
        }
        // t itself changes: x - x_c = (p + t_c d) - x_c + (t - t_c) d.
        const double change = (radius + pointWay) / shortest;
        const double need = (pointWay + change * directionWay) / std::cos(variation + slope);
        if (need > radius) {
            radius = 1.02 * need;
            continue;
        }
        RegionBounds bounds;
        bounds.normals = {n, variation + 1e-12};
        // Within the ball, and within a slab about the tangent plane: no way of this length climbs more.
        const double climb = radius * std::sin(std::min(variation, 0.5 * base::kPi)) + 1e-12 * radius;
        for (int i = 0; i < 3; ++i) {
            const double across = radius * std::sqrt(std::max(0.0, 1.0 - n[i] * n[i]));
            const double extent = std::min(radius, across + climb * std::abs(n[i])) * (1.0 + 1e-12);
            bounds.box.lower[i] = center.at.position[i] - extent;
            bounds.box.upper[i] = center.at.position[i] + extent;
        }
        return bounds;
    }
    return std::nullopt;
}

// Nothing lies farther from the planar face than the capture radius.
RegionBounds ProjectedSurface::boundByHull(std::uint32_t patch, const Region& region) const {
    Box box;
    for (const Vec2d& at : hullOf(region)) {
        box.extend(chartAt(patch, at).point);
    }
    RegionBounds bounds;
    bounds.box.lower = box.lower - capture_[patch];
    bounds.box.upper = box.upper + capture_[patch];
    if (isSmooth_[patch] != 0) {
        const Box whole = object_->bounds();
        const double rounding = 1e-12 * whole.diagonal();
        bounds.box.lower = glm::max(bounds.box.lower, whole.lower - rounding);
        bounds.box.upper = glm::min(bounds.box.upper, whole.upper + rounding);
    }
    bounds.normals.halfAngle = base::kPi;
    return bounds;
}

RegionBounds ProjectedSurface::boundByParts(std::uint32_t patch, const Region& region,
                                            unsigned levels) const {
    if (const auto proven = boundByContinuation(patch, region)) {
        return *proven;
    }
    if (levels == 0) {
        return boundByHull(patch, region);
    }
    std::optional<RegionBounds> all;
    for (const Region& part : childRegions(*this, patch, region, Split::quarters)) {
        const RegionBounds bounds = boundByParts(patch, part, levels - 1);
        if (!all) {
            all = bounds;
        } else {
            all->box.extend(bounds.box);
            all->normals = NormalCone::merge(all->normals, bounds.normals);
        }
    }
    return *all;
}

RegionBounds ProjectedSurface::bounds(std::uint32_t patch, const Region& region) const {
    return isSmooth_[patch] != 0 ? boundByParts(patch, region, kPartLevels) : boundByHull(patch, region);
}

}  // namespace fluxwalk::surface
