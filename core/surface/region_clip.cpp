#include "core/surface/region_clip.h"

#include <cmath>

#include "core/surface/quadrature.h"
#include "core/surface/region.h"

namespace fluxwalk::surface {

namespace {

/// Distance from side k of a domain, positive inside: u, v, and 1 - u and 1 - v or 1 - u - v.
double insideSide(PatchDomain domain, std::size_t side, const Vec2d& p) {
    switch (side) {
        case 0:
            return p.x;
        case 1:
            return p.y;
        case 2:
            return domain == PatchDomain::quad ? 1.0 - p.x : 1.0 - p.x - p.y;
        default:
            return 1.0 - p.y;
    }
}

constexpr std::size_t sideCount(PatchDomain domain) {
    return domain == PatchDomain::quad ? 4 : 3;
}

}  // namespace

Region mapInto(const ParameterMap& part, const Region& region) {
    Region result = region;
    for (Vec2d& corner : result.corners) {
        corner = part.inverse(corner);
    }
    return result;
}

bool coversDomain(const Region& region, PatchDomain domain) {
    const Region whole = wholePatch(domain);
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        const Vec2d& a = region.corners[i];
        const Vec2d edge = region.corners[(i + 1) % region.cornerCount] - a;
        for (std::uint32_t k = 0; k < whole.cornerCount; ++k) {
            const Vec2d p = whole.corners[k] - a;
            if (edge.x * p.y - edge.y * p.x < 0.0) {
                return false;
            }
        }
    }
    return true;
}

bool liesInDomain(const Region& region, PatchDomain domain) {
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        for (std::size_t side = 0; side < sideCount(domain); ++side) {
            if (insideSide(domain, side, region.corners[i]) < -kRegionRounding) {
                return false;
            }
        }
    }
    return true;
}

bool overlapsDomain(const Region& region, PatchDomain domain) {
    for (std::size_t side = 0; side < sideCount(domain); ++side) {
        bool anyInside = false;
        for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
            anyInside = anyInside || insideSide(domain, side, region.corners[i]) > kRegionRounding;
        }
        if (!anyInside) {
            return false;
        }
    }
    if (domain == PatchDomain::quad) {
        return true;
    }
    // The triangle's own corners do not reach past u = 1 and v = 1; sides of regions may lie there.
    for (const bool alongU : {true, false}) {
        bool anyInside = false;
        for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
            const Vec2d& p = region.corners[i];
            anyInside = anyInside || (alongU ? p.x : p.y) < 1.0 - kRegionRounding;
        }
        if (!anyInside) {
            return false;
        }
    }
    return true;
}

ClippedRegion clipToDomain(const Region& region, PatchDomain domain) {
    ClippedRegion polygon;
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        polygon.corners[polygon.count++] = region.corners[i];
    }
    for (std::size_t side = 0; side < sideCount(domain); ++side) {
        ClippedRegion clipped;
        for (std::size_t i = 0; i < polygon.count; ++i) {
            const Vec2d& a = polygon.corners[i];
            const Vec2d& b = polygon.corners[(i + 1) % polygon.count];
            const double insideA = insideSide(domain, side, a);
            const double insideB = insideSide(domain, side, b);
            if (insideA >= 0.0) {
                clipped.corners[clipped.count++] = a;
            }
            if ((insideA > 0.0 && insideB < 0.0) || (insideA < 0.0 && insideB > 0.0)) {
                clipped.corners[clipped.count++] = a + insideA / (insideA - insideB) * (b - a);
            }
        }
        polygon = clipped;
    }
    return polygon;
}

double integrateArea(const BezierPiece& piece, const Region& polygon) {
    return integrateOver(polygon, [&](const Vec2d& uv) {
        const Tangents p = evaluatePiece(piece, uv);
        return glm::length(glm::cross(p.du, p.dv));
    });
}

}  // namespace fluxwalk::surface
