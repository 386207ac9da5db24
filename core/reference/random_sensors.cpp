#include "core/reference/random_sensors.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/surface/region.h"

namespace fluxwalk::reference {

namespace {

struct PatchSide {
    ObjectSide side;
    std::uint32_t patch = 0;
    double cumulativeArea = 0.0;
};

// Point of a patch with uniform density over its area: parameters are drawn uniformly and kept with
// probability proportional to the area measure.
surface::SurfacePoint uniformPoint(const surface::Surface& surface, std::uint32_t patch,
                                   base::RandomStream& random) {
    const surface::Region whole = surface::wholePatch(surface.domain(patch));
    constexpr int kProbes = 9;
    double largest = 0.0;
    for (int i = 0; i < kProbes; ++i) {
        for (int j = 0; j < kProbes; ++j) {
            const base::Vec2d st(i / (kProbes - 1.0), j / (kProbes - 1.0));
            largest = std::max(largest, surface.evaluate(patch, mapToRegion(whole, st).uv).jacobian);
        }
    }
    while (true) {
        const base::Vec2d uv = mapToRegion(whole, random.next2()).uv;
        const surface::SurfacePoint point = surface.evaluate(patch, uv);
        if (random.next() * largest <= point.jacobian) {
            return point;
        }
    }
}

}  // namespace

std::vector<scene::Sensor> randomSensors(const scene::Scene& scene, std::span<const ObjectSide> sides,
                                         std::size_t count, std::uint64_t seed) {
    std::vector<PatchSide> table;
    double area = 0.0;
    for (const ObjectSide& side : sides) {
        const surface::Surface& surface = *scene.objects[side.object].surface;
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            area += surface.area(patch, surface::wholePatch(surface.domain(patch)));
            table.push_back({side, patch, area});
        }
    }
    FLUXWALK_CHECK_LT(0.0, area);
    std::vector<scene::Sensor> sensors;
    sensors.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        base::RandomStream random(base::combine(seed, i));
        const double choice = random.next() * area;
        const auto found = std::upper_bound(
            table.begin(), table.end(), choice,
            [](double value, const PatchSide& entry) { return value < entry.cumulativeArea; });
        const PatchSide& entry = found == table.end() ? table.back() : *found;
        const surface::SurfacePoint point =
            uniformPoint(*scene.objects[entry.side.object].surface, entry.patch, random);
        sensors.push_back({point.position, entry.side.back ? -point.normal : point.normal});
    }
    return sensors;
}

}  // namespace fluxwalk::reference
