#include "core/hierarchy/exposure.h"

#include <bit>

namespace fluxwalk::hierarchy {

std::uint16_t findExposedCells(const rays::RayScene& rays, const ReachedSides& reached,
                               const surface::Surface& surface, std::uint32_t patch, bool back,
                               const surface::Region& region) {
    std::uint16_t cells = 0;
    for (unsigned j = 0; j < 4; ++j) {
        for (unsigned i = 0; i < 4; ++i) {
            const Vec3d at(0.125 + 0.25 * i, 0.125 + 0.25 * j, 0.0);
            const surface::SurfacePoint p =
                surface.evaluate(patch, surface::mapToRegion(region, {at.x, at.y}).uv);
            const Vec3d n = back ? -p.normal : p.normal;
            const auto hit = rays.closest(rays.halfLine(p.position, n, n));
            if (!hit || reached.isReached(base::index(hit->object), hit->back)) {
                cells = static_cast<std::uint16_t>(cells | (1u << (4 * j + i)));
            }
        }
    }
    return cells;
}

float exposedFraction(std::uint16_t cells) {
    return static_cast<float>(std::popcount(cells)) / 16.0f;
}

}  // namespace fluxwalk::hierarchy
