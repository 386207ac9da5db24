#include "core/surface/integrate_area.h"

#include <cmath>

#include "core/surface/region.h"

namespace fluxwalk::surface {

namespace {

double refineArea(const Surface& surface, std::uint32_t patch, const Region& region, double once, int depth) {
    constexpr double kTolerance = 1e-12;
    constexpr int kDeepest = 8;
    const std::array<Region, 4> parts = childRegions(surface, patch, region, Split::quarters);
    std::array<double, 4> areas{};
    double sum = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        areas[i] = surface.Surface::area(patch, parts[i]);
        sum += areas[i];
    }
    if (depth == kDeepest || std::abs(sum - once) <= kTolerance * once) {
        return sum;
    }
    sum = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        sum += refineArea(surface, patch, parts[i], areas[i], depth + 1);
    }
    return sum;
}

}  // namespace

double integrateArea(const Surface& surface, std::uint32_t patch, const Region& region) {
    return refineArea(surface, patch, region, surface.Surface::area(patch, region), 0);
}

}  // namespace fluxwalk::surface
