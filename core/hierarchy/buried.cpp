#include "core/hierarchy/buried.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/random.h"
#include "core/hierarchy/explorer.h"
#include "core/surface/region.h"

namespace fluxwalk::hierarchy {

namespace {

using base::Vec2d;
using base::Vec3d;

/// Points at least and at most, and the area in m2 that one stands for between.
constexpr std::size_t kFewestPoints = 32;
constexpr std::size_t kMostPoints = 512;
constexpr double kAreaPerPoint = 0.01;
/// Distance of the outermost points from the corners and edges, in parts of the patch.
constexpr double kMargin = 0.01;
/// Of a ray against the normal.
constexpr double kTilt = 1.6;
/// Surfaces that a walk meets until it counts as lit: from a patch's first point, which most lit patches need
/// alone, and from the others, which must not miss the dark where solids touch on all sides.
constexpr unsigned kFirstHops = 4;
constexpr unsigned kMoreHops = 24;

// Points of the unit square: near corners and middles of edges first, then spread evenly.
Vec2d pointAt(std::size_t i, const Vec2d& shift) {
    constexpr std::size_t kRim = 8;
    if (i < kRim) {
        constexpr std::array<double, 3> kPlaces{kMargin, 0.5, 1.0 - kMargin};
        constexpr std::array<std::array<std::size_t, 2>, kRim> kOrder{
            {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 0}, {1, 2}, {0, 1}, {2, 1}}};
        return {kPlaces[kOrder[i][0]], kPlaces[kOrder[i][1]]};
    }
    return base::r2Point(i - kRim, shift);
}

// Whether a walk from a point on a surface comes to a side that light does not reach, or leaves a scene that
// no light leaves: then all of its way is dark. Where two solids touch, a ray inside of one may report the
// other's face, which is reached elsewhere; so the walk goes on from there.
bool isDark(const Explorer& explorer, const ReachedSides& reached, Stand at, unsigned hops,
            base::RandomStream& random) {
    for (unsigned hop = 0; hop < hops; ++hop) {
        // Tilted at random, so that no ray runs along an edge of what it is to meet.
        const Vec3d direction =
            at.normal + kTilt * Vec3d(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5);
        const Explorer::Step step = explorer.step(at, direction);
        if (step.escaped) {
            return !reached.isOpen;
        }
        if (!reached.isReached(step.object, step.back)) {
            return true;
        }
        at = step.at;
    }
    return false;
}

bool isBuried(const Explorer& explorer, const ReachedSides& reached, const surface::Surface& surface,
              std::uint32_t patch, bool back, std::uint64_t key) {
    const surface::Region whole = surface::wholePatch(surface.domain(patch));
    const auto count = static_cast<std::size_t>(std::clamp(surface.area(patch, whole) / kAreaPerPoint,
                                                           static_cast<double>(kFewestPoints),
                                                           static_cast<double>(kMostPoints)));
    base::RandomStream random(key);
    const Vec2d shift = random.next2();
    for (std::size_t i = 0; i < count; ++i) {
        const surface::SurfacePoint p =
            surface.evaluate(patch, surface::mapToRegion(whole, pointAt(i, shift)).uv);
        if (!isDark(explorer, reached, {p.position, back ? -p.normal : p.normal},
                    i == 0 ? kFirstHops : kMoreHops, random)) {
            return false;
        }
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> findBuriedPatches(const scene::Scene& scene, const rays::RayScene& rays,
                                            const base::Executor& executor, const ReachedSides& reached,
                                            std::uint64_t seed) {
    const Explorer explorer(scene, rays);
    std::vector<std::uint8_t> buried(reached.firstPatch.back(), 0);
    executor.forRange(scene.objects.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t o = begin; o < end; ++o) {
            const surface::Surface& surface = *scene.objects[o].surface;
            for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
                const std::size_t item = reached.firstPatch[o] + patch;
                for (const bool back : {false, true}) {
                    if (reached.isReached(static_cast<std::uint32_t>(o), back) &&
                        isBuried(explorer, reached, surface, patch, back,
                                 base::combine(seed, 2 * item + (back ? 1 : 0)))) {
                        buried[item] |= back ? 2 : 1;
                    }
                }
            }
        }
    });
    return buried;
}

}  // namespace fluxwalk::hierarchy
