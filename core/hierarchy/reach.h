#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/rays/ray_scene.h"

namespace fluxwalk::hierarchy {

/// Which sides of each object light can reach: [0] the front, [1] the back. A side that is not reached takes
/// no part in the transport and still blocks; so the inside of a closed solid is told from the room around
/// it.
struct ReachedSides {
    std::vector<std::array<bool, 2>> sides;
    /// Whether any of that light left the scene: false means that the scene is closed.
    bool isOpen = false;

    bool isReached(std::uint32_t object, bool back) const { return sides[object][back ? 1 : 0]; }
};

/// Found by walks of light: forwards from every emitter, and backwards from every side that those did not
/// meet. (Whether a side merely sees a reached side proves nothing: the floor under a box sees its inside.)
ReachedSides findReachedSides(const scene::Scene& scene, const rays::RayScene& rays,
                              const base::Executor& executor, std::uint64_t seed);

}  // namespace fluxwalk::hierarchy
