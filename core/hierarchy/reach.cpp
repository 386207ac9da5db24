#include "core/hierarchy/reach.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/surface/region.h"

namespace fluxwalk::hierarchy {

using base::Vec2d;
using base::Vec3d;

namespace {

/// Rays from each side of each object; a side that is missed by all of them sees less than about 1 % of what light reaches.
constexpr unsigned kRaysPerSide = 384;

struct SideView {
    std::vector<std::uint32_t> seen;  ///< sides met, as object * 2 + back, sorted
    bool seesLight = false;
    bool escapes = false;
};

// Cosine-weighted direction about n.
Vec3d cosineDirection(const Vec3d& n, const Vec2d& u) {
    const double radius = std::sqrt(u.x);
    const double angle = 2.0 * base::kPi * u.y;
    const Vec3d helper = std::abs(n.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d t = glm::normalize(glm::cross(n, helper));
    return radius * std::cos(angle) * t + radius * std::sin(angle) * glm::cross(n, t) +
           std::sqrt(std::max(0.0, 1.0 - u.x)) * n;
}

bool seesLight(const scene::Scene& scene, const rays::RayScene& rays, const Vec3d& x, const Vec3d& n) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const scene::Light& light) {
        if (light.kind == scene::LightKind::directional) {
            return glm::dot(n, light.direction) < 0.0 && !rays.isOccluded(rays.halfLine(x, n, -light.direction));
        }
        const Vec3d toLight = light.position - x;
        return glm::dot(n, toLight) > 0.0 && !rays.isOccluded(rays.segment(x, n, light.position, Vec3d(0.0)));
    });
}

SideView look(const scene::Scene& scene, const rays::RayScene& rays, std::uint32_t object, bool back,
              std::uint64_t seed) {
    SideView view;
    const surface::Surface& surface = *scene.objects[object].surface;
    const std::uint32_t patches = surface.patchCount();
    base::RandomStream random(base::combine(base::combine(seed, object), back ? 1 : 0));
    for (unsigned i = 0; i < kRaysPerSide; ++i) {
        // Patches in turn where there are few, a spread of them where there are many.
        const auto patch = static_cast<std::uint32_t>(patches <= kRaysPerSide
                                                          ? i % patches
                                                          : static_cast<std::uint64_t>(i) * patches / kRaysPerSide);
        const surface::Region whole = surface::wholePatch(surface.domain(patch));
        const surface::SurfacePoint p = surface.evaluate(patch, surface::mapToRegion(whole, random.next2()).uv);
        const Vec3d n = back ? -p.normal : p.normal;
        const Vec3d direction = cosineDirection(n, random.next2());
        const auto hit = rays.closest(rays.halfLine(p.position, n, direction));
        if (hit) {
            view.seen.push_back(base::index(hit->object) * 2 + (hit->back ? 1u : 0u));
        } else {
            view.escapes = true;
            view.seesLight = view.seesLight || (scene.sky != base::Rgb(0.0f) && direction.y > 0.0);
        }
        if (!view.seesLight && i % 4 == 0) {
            view.seesLight = seesLight(scene, rays, p.position, n);
        }
    }
    std::sort(view.seen.begin(), view.seen.end());
    view.seen.erase(std::unique(view.seen.begin(), view.seen.end()), view.seen.end());
    return view;
}

}  // namespace

ReachedSides findReachedSides(const scene::Scene& scene, const rays::RayScene& rays, const base::Executor& executor,
                              std::uint64_t seed) {
    const std::size_t sideCount = scene.objects.size() * 2;
    std::vector<SideView> views(sideCount);
    executor.forRange(sideCount, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            const auto object = static_cast<std::uint32_t>(s / 2);
            if (scene.objects[object].surface->patchCount() > 0) {
                views[s] = look(scene, rays, object, s % 2 == 1, seed);
            }
        }
    });
    // Seeing is mutual: collect both directions, then spread from what emits.
    std::vector<std::vector<std::uint32_t>> neighbours(sideCount);
    for (std::uint32_t s = 0; s < sideCount; ++s) {
        for (const std::uint32_t other : views[s].seen) {
            neighbours[s].push_back(other);
            neighbours[other].push_back(s);
        }
    }
    std::vector<std::uint32_t> frontier;
    std::vector<bool> reached(sideCount, false);
    for (std::uint32_t s = 0; s < sideCount; ++s) {
        const scene::Material& material = scene.materials[scene.objects[s / 2].material];
        const bool emits = material.isEmissive() && (s % 2 == 0 || material.doubleSided) &&
                           scene.objects[s / 2].surface->patchCount() > 0;
        if (emits || views[s].seesLight) {
            reached[s] = true;
            frontier.push_back(s);
        }
    }
    while (!frontier.empty()) {
        const std::uint32_t s = frontier.back();
        frontier.pop_back();
        for (const std::uint32_t other : neighbours[s]) {
            if (!reached[other]) {
                reached[other] = true;
                frontier.push_back(other);
            }
        }
    }
    ReachedSides result;
    result.sides.resize(scene.objects.size());
    for (std::uint32_t s = 0; s < sideCount; ++s) {
        result.sides[s / 2][s % 2] = reached[s];
        result.isOpen = result.isOpen || (reached[s] && views[s].escapes);
    }
    return result;
}

}  // namespace fluxwalk::hierarchy
