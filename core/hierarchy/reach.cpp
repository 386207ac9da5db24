#include "core/hierarchy/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/hierarchy/buried.h"
#include "core/hierarchy/cavities.h"
#include "core/hierarchy/closed_mesh.h"
#include "core/hierarchy/explorer.h"
#include "core/hierarchy/joined_sets.h"
#include "core/rays/spatial_tree.h"
#include "core/rays/tree_builder.h"
#include "core/surface/region.h"

namespace fluxwalk::hierarchy {

using base::Vec2d;
using base::Vec3d;

namespace {

/// Light is followed from every emitter for this many walks, and from every side that they did not meet,
/// backwards.
constexpr unsigned kForwardWalks = 512;
constexpr unsigned kBackwardWalks = 128;
/// Walks inside of a closed mesh that holds no emitter.
constexpr unsigned kInsideWalks = 4;
/// Light of the sun, which has no place to start from, is followed this often from every side it is found on.
constexpr unsigned kOnwardWalks = 8;
constexpr unsigned kMaxBounces = 16;

std::uint32_t sideOf(std::uint32_t object, bool back) {
    return object * 2 + (back ? 1u : 0u);
}

/// Steps of light from side to side, as object * 2 + back (lights without area stand behind all sides), and
/// whether any left the scene.
struct Found {
    std::vector<std::array<std::uint32_t, 2>> steps;
    bool escaped = false;

    void sortSteps() {
        std::sort(steps.begin(), steps.end());
        steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    }
};

// Light that goes from a stand on side `from`, bouncing off whatever it meets.
void follow(const Explorer& explorer, std::uint32_t from, Stand at, Vec3d direction,
            base::RandomStream& random, Found& found) {
    for (unsigned bounce = 0; bounce < kMaxBounces; ++bounce) {
        const Explorer::Step step = explorer.step(at, direction);
        if (step.escaped) {
            found.escaped = true;
            return;
        }
        const std::uint32_t to = sideOf(step.object, step.back);
        found.steps.push_back({from, to});
        from = to;
        at = step.at;
        direction = cosineDirection(at.normal, random.next2());
    }
}

// Whether light can come to a side: walks backwards until one sees an emitter.
bool isLit(const scene::Scene& scene, const Explorer& explorer, std::uint32_t object, bool back,
           unsigned walks, std::uint64_t key, Found& found) {
    base::RandomStream random(key);
    for (unsigned walk = 0; walk < walks; ++walk) {
        Stand at = explorer.stand(object, back, walk, walks, random);
        std::uint32_t from = sideOf(object, back);
        for (unsigned bounce = 0; bounce < kMaxBounces; ++bounce) {
            if (explorer.seesEmitter(at, random)) {
                for (unsigned onward = 0; onward < kOnwardWalks && !found.escaped; ++onward) {
                    follow(explorer, from, at, cosineDirection(at.normal, random.next2()), random, found);
                }
                return true;
            }
            const Explorer::Step step = explorer.step(at, cosineDirection(at.normal, random.next2()));
            if (step.escaped) {
                if (step.escapedUp && scene.sky != base::Rgb(0.0f)) {
                    found.escaped = true;
                    return true;
                }
                break;
            }
            const std::uint32_t to = sideOf(step.object, step.back);
            found.steps.push_back({from, to});
            from = to;
            if (explorer.emits(step.object, step.back)) {
                return true;
            }
            at = step.at;
        }
    }
    return false;
}

// Sides that steps join, directly or through others, get the same number.
std::vector<std::uint32_t> findRooms(std::size_t sideCount, std::size_t sourceCount,
                                     std::initializer_list<std::span<const Found>> walks) {
    JoinedSets sets(sideCount + sourceCount);
    for (const std::span<const Found> some : walks) {
        for (const Found& found : some) {
            for (const auto& [from, to] : found.steps) {
                sets.join(from, to);
            }
        }
    }
    std::vector<std::uint32_t> rooms(sideCount);
    for (std::uint32_t side = 0; side < sideCount; ++side) {
        rooms[side] = sets.top(side);
    }
    return rooms;
}

/// Where light begins, to be looked up by place.
class EmitterPlaces {
  public:
    EmitterPlaces(const scene::Scene& scene, const Explorer& explorer, const base::Executor& executor) {
        std::vector<base::Box> boxes;
        for (const std::uint32_t object : explorer.emitters()) {
            boxes.push_back(scene.objects[object].surface->bounds());
        }
        for (const scene::Light& light : scene.lights) {
            if (light.kind != scene::LightKind::directional) {
                boxes.push_back({light.position, light.position});
            }
        }
        if (!boxes.empty()) {
            tree_ = rays::buildTree(rays::TreeBuilder::sah, {boxes}, executor);
        }
    }

    bool reachInto(const base::Box& box) const {
        const base::Vec3 lower(box.lower);
        const base::Vec3 upper(box.upper);
        std::vector<std::uint32_t> stack;
        if (!tree_.nodes().empty()) {
            stack.push_back(0);
        }
        while (!stack.empty()) {
            const std::uint32_t at = stack.back();
            stack.pop_back();
            const rays::SpatialTree::Node& node = tree_.nodes()[at];
            if (glm::any(glm::greaterThan(node.lower, upper)) || glm::any(glm::lessThan(node.upper, lower))) {
                continue;
            }
            if (node.isLeaf()) {
                return true;
            }
            stack.push_back(node.right);
            stack.push_back(at + 1);
        }
        return false;
    }

  private:
    rays::SpatialTree tree_;
};

}  // namespace

ReachedSides findReachedSides(const scene::Scene& scene, const rays::RayScene& rays,
                              const base::Executor& executor, std::uint64_t seed) {
    const Explorer explorer(scene, rays);
    const std::size_t sideCount = scene.objects.size() * 2;
    const std::size_t sourceCount = explorer.emitters().size() + scene.lights.size();
    // A few thousand walks in all where there are many emitters.
    const unsigned walks = static_cast<unsigned>(
        std::clamp<std::size_t>(sourceCount == 0 ? 0 : 65536 / sourceCount, 16, kForwardWalks));
    std::vector<Found> forward(sourceCount);
    executor.forRange(sourceCount, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            base::RandomStream random(base::combine(seed, s));
            for (unsigned walk = 0; walk < walks; ++walk) {
                if (s < explorer.emitters().size()) {
                    const std::uint32_t object = explorer.emitters()[s];
                    const bool back = explorer.emits(object, true) && walk % 2 == 1;
                    const Stand at = explorer.stand(object, back, walk, walks, random);
                    follow(explorer, sideOf(object, back), at, cosineDirection(at.normal, random.next2()),
                           random, forward[s]);
                } else if (scene.lights[s - explorer.emitters().size()].kind !=
                           scene::LightKind::directional) {
                    const scene::Light& light = scene.lights[s - explorer.emitters().size()];
                    const double y = 1.0 - 2.0 * random.next();
                    const double angle = 2.0 * base::kPi * random.next();
                    const double flat = std::sqrt(std::max(0.0, 1.0 - y * y));
                    const Vec3d direction(flat * std::cos(angle), y, flat * std::sin(angle));
                    const base::Rgb there = scene::intensityToward(light, direction);
                    if (there != base::Rgb(0.0f)) {
                        const auto from = static_cast<std::uint32_t>(sideCount + s);
                        follow(explorer, from, {light.position, Vec3d(0.0)}, direction, random, forward[s]);
                    }
                }
            }
            forward[s].sortSteps();
        }
    });
    ReachedSides result;
    result.sides.assign(scene.objects.size(), {false, false});
    for (const Found& found : forward) {
        result.isOpen = result.isOpen || found.escaped;
        for (const auto& [from, to] : found.steps) {
            result.sides[to / 2][to % 2] = true;
        }
    }
    const EmitterPlaces places(scene, explorer, executor);
    std::vector<std::uint8_t> lit(sideCount, 0);
    std::vector<Found> backward(sideCount);
    executor.forRange(sideCount, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            const auto object = static_cast<std::uint32_t>(s / 2);
            const bool back = s % 2 == 1;
            if (scene.objects[object].surface->patchCount() > 0 && !result.sides[object][back ? 1 : 0]) {
                const surface::Surface& surface = *scene.objects[object].surface;
                const bool isOpaque =
                    scene.materials[scene.objects[object].material].alphaMode == scene::AlphaMode::opaque;
                const bool isInside =
                    back && isOpaque && !places.reachInto(surface.bounds()) && isClosedOutwards(surface);
                const bool is = explorer.emits(object, back) ||
                                isLit(scene, explorer, object, back, isInside ? kInsideWalks : kBackwardWalks,
                                      base::combine(seed + 1, s), backward[s]);
                lit[s] = is ? 1 : 0;
                backward[s].sortSteps();
            }
        }
    });
    for (std::size_t s = 0; s < sideCount; ++s) {
        result.sides[s / 2][s % 2] = result.sides[s / 2][s % 2] || lit[s] != 0;
        result.isOpen = result.isOpen || backward[s].escaped;
    }
    result.rooms = findRooms(sideCount, sourceCount, {forward, backward});
    result.firstPatch.push_back(0);
    for (const scene::Object& object : scene.objects) {
        result.firstPatch.push_back(result.firstPatch.back() + object.surface->patchCount());
    }
    result.buried = findBuriedPatches(scene, rays, executor, result, seed + 2);
    const std::vector<std::uint8_t> cavities = findCavities(scene, rays, executor, result, seed + 3);
    for (std::size_t i = 0; i < cavities.size(); ++i) {
        result.buried[i] |= cavities[i];
    }
    return result;
}

}  // namespace fluxwalk::hierarchy
