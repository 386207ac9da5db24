#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/rays/ray_scene.h"

namespace fluxwalk::hierarchy {

/// Which sides of each object light can reach: [0] the front, [1] the back. A side that is not reached takes
/// no part in the transport and still blocks; so the inside of a closed solid is told from the room around
/// it. Of a side that is reached, patches that lie wholly inside other solids (buried.h) or in
/// dark cavities (cavities.h) take no part either.
struct ReachedSides {
    std::vector<std::array<bool, 2>> sides;
    /// Where the patches of each object begin in `buried`, and their number at the end.
    std::vector<std::size_t> firstPatch;
    std::vector<std::uint8_t> buried;  ///< or in a cavity, of each patch: bit 0 its front, bit 1 its back
    /// Of each side, at object * 2 + (back ? 1 : 0): sides between which walks went have the same number.
    /// Different ones may be sealed off from each other, though they lie on the two sides of one wall.
    std::vector<std::uint32_t> rooms;
    /// Whether any of that light left the scene: false means that the scene is closed.
    bool isOpen = false;

    bool isReached(std::uint32_t object, bool back) const { return sides[object][back ? 1 : 0]; }
    bool isReached(std::uint32_t object, std::uint32_t patch, bool back) const {
        return isReached(object, back) && (buried[firstPatch[object] + patch] & (back ? 2u : 1u)) == 0;
    }
};

/// Found by walks of light: forwards from every emitter, and backwards from every side that those did not
/// meet. The insides of closed meshes without an emitter in them are dark, and are looked into only briefly
/// in case a mesh pierces itself. (Whether a side merely sees a reached side proves nothing: the floor under
/// a box sees its inside.)
ReachedSides findReachedSides(const scene::Scene& scene, const rays::RayScene& rays,
                              const base::Executor& executor, std::uint64_t seed);

}  // namespace fluxwalk::hierarchy
