#include "core/surface/region.h"

#include <cmath>

namespace fluxwalk::surface {

namespace {

double cross(const Vec2d& a, const Vec2d& b) {
    return a.x * b.y - a.y * b.x;
}

// Smallest signed distance (scaled by edge length) of a point to the inside of a convex region; negative
// outside.
double insideness(const Region& r, const Vec2d& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < r.cornerCount; ++i) {
        const Vec2d& a = r.corners[i];
        const Vec2d& b = r.corners[(i + 1) % r.cornerCount];
        least = std::min(least, cross(b - a, p - a));
    }
    return least;
}

std::array<Region, 4> quarterRegions(const Surface& surface, std::uint32_t patch, const Region& region) {
    const auto& c = region.corners;
    const auto split = [&](std::uint32_t i, std::uint32_t j) {
        return surface.splitPoint(patch, c[i], c[j]);
    };
    if (region.cornerCount == 3) {
        const Vec2d ab = split(0, 1);
        const Vec2d bc = split(1, 2);
        const Vec2d ca = split(2, 0);
        return {Region{{c[0], ab, ca, ca}, 3}, Region{{ab, c[1], bc, bc}, 3}, Region{{ca, bc, c[2], c[2]}, 3},
                Region{{bc, ca, ab, ab}, 3}};
    }
    const Vec2d e0 = split(0, 1);
    const Vec2d e1 = split(1, 2);
    const Vec2d e2 = split(2, 3);
    const Vec2d e3 = split(3, 0);
    const Vec2d middle = surface.splitPoint(patch, e3, e1);
    return {Region{{c[0], e0, middle, e3}, 4}, Region{{e0, c[1], e1, middle}, 4},
            Region{{middle, e1, c[2], e2}, 4}, Region{{e3, middle, e2, c[3]}, 4}};
}

std::array<Region, 4> stripRegions(const Surface& surface, std::uint32_t patch, const Region& region,
                                   bool alongV) {
    // Edges are cut in the middle, and their halves there: the points that quarters of quarters have.
    const auto cut = [&](const Vec2d& from, const Vec2d& to) {
        const Vec2d middle = surface.splitPoint(patch, from, to);
        return std::array{from, surface.splitPoint(patch, from, middle), middle,
                          surface.splitPoint(patch, middle, to), to};
    };
    const auto& c = region.corners;
    const auto first = alongV ? cut(c[0], c[3]) : cut(c[0], c[1]);
    const auto second = alongV ? cut(c[1], c[2]) : cut(c[3], c[2]);
    std::array<Region, 4> strips;
    for (std::size_t k = 0; k < 4; ++k) {
        strips[k] = alongV ? Region{{first[k], second[k], second[k + 1], first[k + 1]}, 4}
                           : Region{{first[k], first[k + 1], second[k + 1], second[k]}, 4};
    }
    return strips;
}

}  // namespace

Region wholePatch(PatchDomain domain) {
    if (domain == PatchDomain::quad) {
        return {{Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{1, 1}, Vec2d{0, 1}}, 4};
    }
    return {{Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{0, 1}, Vec2d{0, 1}}, 3};
}

std::array<Region, 4> childRegions(const Surface& surface, std::uint32_t patch, const Region& region,
                                   Split split) {
    return split == Split::quarters ? quarterRegions(surface, patch, region)
                                    : stripRegions(surface, patch, region, split == Split::stripsAlongV);
}

Region childRegion(const Surface& surface, std::uint32_t patch, const Region& region, Split split,
                   unsigned child) {
    return childRegions(surface, patch, region, split)[child];
}

Region regionOf(const Surface& surface, std::uint32_t patch, Path path) {
    Region region = wholePatch(surface.domain(patch));
    const Strips strips = surface.strips(patch);
    const unsigned levels = pathLevel(path);
    for (unsigned level = 0; level < levels; ++level) {
        region = childRegion(surface, patch, region, splitAt(strips, level), pathStep(path, level));
    }
    return region;
}

RegionPoint mapToRegion(const Region& region, const Vec2d& st) {
    const auto& c = region.corners;
    if (region.cornerCount == 3) {
        const double root = std::sqrt(st.x);
        const double u = 1.0 - root;
        const double v = st.y * root;
        return {(1.0 - u - v) * c[0] + u * c[1] + v * c[2], 0.5 * std::abs(cross(c[1] - c[0], c[2] - c[0]))};
    }
    const double s = st.x;
    const double t = st.y;
    const Vec2d uv = (1 - t) * ((1 - s) * c[0] + s * c[1]) + t * ((1 - s) * c[3] + s * c[2]);
    const Vec2d ds = (1 - t) * (c[1] - c[0]) + t * (c[2] - c[3]);
    const Vec2d dt = (1 - s) * (c[3] - c[0]) + s * (c[2] - c[1]);
    return {uv, std::abs(cross(ds, dt))};
}

unsigned childAt(const Surface& surface, std::uint32_t patch, const Region& region, Split split,
                 const Vec2d& uv) {
    unsigned best = 0;
    double bestInside = -std::numeric_limits<double>::infinity();
    const std::array<Region, 4> children = childRegions(surface, patch, region, split);
    for (unsigned child = 0; child < 4; ++child) {
        const double inside = insideness(children[child], uv);
        if (inside > bestInside) {
            bestInside = inside;
            best = child;
        }
    }
    return best;
}

}  // namespace fluxwalk::surface
