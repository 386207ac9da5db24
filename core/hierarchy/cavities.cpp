#include "core/hierarchy/cavities.h"

#include <array>

#include "core/base/random.h"
#include "core/hierarchy/explorer.h"
#include "core/hierarchy/joined_sets.h"
#include "core/surface/region.h"

namespace fluxwalk::hierarchy {

namespace {

/// Walks from each patch: first one, which joins nearly all that is lit; then more from what is left, in
/// rounds, as each may join much.
struct Round {
    unsigned walks = 0;
    unsigned hops = 0;
};
constexpr std::array<Round, 4> kRounds{{{1, 4}, {3, 16}, {32, 16}, {64, 16}}};

/// What walks from one side of a patch found.
struct Walked {
    std::vector<std::uint32_t> met;  ///< sides: twice the patch's number, one more for its back
    bool sawLight = false;
};

}  // namespace

std::vector<std::uint8_t> findCavities(const scene::Scene& scene, const rays::RayScene& rays,
                                       const base::Executor& executor, const ReachedSides& reached,
                                       std::uint64_t seed) {
    const Explorer explorer(scene, rays);
    const std::size_t patches = reached.firstPatch.back();
    std::vector<std::uint32_t> objectOf(patches);
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        for (std::size_t item = reached.firstPatch[o]; item < reached.firstPatch[o + 1]; ++item) {
            objectOf[item] = o;
        }
    }
    const auto patchOf = [&](std::size_t item) {
        return static_cast<std::uint32_t>(item - reached.firstPatch[objectOf[item]]);
    };
    JoinedSets sets(2 * patches);
    std::vector<std::uint8_t> isLit(2 * patches, 0);
    std::vector<std::uint32_t> open;  // sides not known to be lit
    for (std::uint32_t side = 0; side < 2 * patches; ++side) {
        const std::uint32_t object = objectOf[side / 2];
        if (reached.isReached(object, patchOf(side / 2), side % 2 == 1)) {
            isLit[side] = explorer.emits(object, side % 2 == 1) ? 1 : 0;
            open.push_back(side);
        }
    }
    const auto walkFrom = [&](std::uint32_t start, const Round& round, std::uint64_t key) {
        Walked walked;
        base::RandomStream random(key);
        const std::uint32_t object = objectOf[start / 2];
        const surface::Surface& surface = *scene.objects[object].surface;
        const std::uint32_t patch = patchOf(start / 2);
        const surface::Region whole = surface::wholePatch(surface.domain(patch));
        for (unsigned walk = 0; walk < round.walks && !walked.sawLight; ++walk) {
            const surface::SurfacePoint p =
                surface.evaluate(patch, surface::mapToRegion(whole, random.next2()).uv);
            Stand at{p.position, start % 2 == 1 ? -p.normal : p.normal};
            for (unsigned hop = 0; hop < round.hops && !walked.sawLight; ++hop) {
                walked.sawLight = !scene.lights.empty() && explorer.seesEmitter(at, random);
                const Explorer::Step step = explorer.step(at, cosineDirection(at.normal, random.next2()));
                if (step.escaped) {
                    walked.sawLight = walked.sawLight || reached.isOpen;
                    break;
                }
                if (!reached.isReached(step.object, step.patch, step.back)) {
                    break;
                }
                walked.met.push_back(static_cast<std::uint32_t>(
                    2 * (reached.firstPatch[step.object] + step.patch) + (step.back ? 1 : 0)));
                at = step.at;
            }
        }
        return walked;
    };
    for (std::size_t r = 0; r < kRounds.size() && !open.empty(); ++r) {
        std::vector<Walked> walks(open.size());
        executor.forRange(open.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                walks[i] = walkFrom(open[i], kRounds[r], base::combine(base::combine(seed, r), open[i]));
            }
        });
        for (std::size_t i = 0; i < open.size(); ++i) {
            isLit[open[i]] = isLit[open[i]] != 0 || walks[i].sawLight ? 1 : 0;
            for (const std::uint32_t met : walks[i].met) {
                sets.join(open[i], met);
            }
        }
        std::vector<std::uint8_t> isSetLit(2 * patches, 0);
        for (std::uint32_t side = 0; side < 2 * patches; ++side) {
            isSetLit[sets.top(side)] |= isLit[side];
        }
        std::erase_if(open, [&](std::uint32_t side) { return isSetLit[sets.top(side)] != 0; });
    }
    std::vector<std::uint8_t> cavities(patches, 0);
    for (const std::uint32_t side : open) {
        cavities[side / 2] = static_cast<std::uint8_t>(cavities[side / 2] | (side % 2 == 1 ? 2 : 1));
    }
    return cavities;
}

}  // namespace fluxwalk::hierarchy
