#include "core/surface/surface.h"

#include "core/surface/quadrature.h"

namespace fluxwalk::surface {

Strips Surface::strips(std::uint32_t /*patch*/) const {
    return {};
}

Vec2d Surface::splitPoint(std::uint32_t /*patch*/, const Vec2d& a, const Vec2d& b) const {
    return 0.5 * (a + b);
}

bool Surface::normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const {
    return bounds(patch, region).normals.halfAngle <= halfAngle;
}

double Surface::area(std::uint32_t patch, const Region& region) const {
    return integrateOver(region, [&](const Vec2d& uv) { return evaluate(patch, uv).jacobian; });
}

std::optional<double> Surface::exactKernel(bool /*back*/) const {
    return std::nullopt;
}

bool Surface::isConvexAround(const Box& /*box*/) const {
    return false;
}

TriangleView Surface::triangles() const {
    return {};
}

}  // namespace fluxwalk::surface
