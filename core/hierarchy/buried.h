#pragma once

#include <cstdint>
#include <vector>

#include "core/hierarchy/reach.h"

namespace fluxwalk::hierarchy {

/// For each patch, in the order of objects, bit 0 where its front and bit 1 where its back lies wholly in the
/// dark, inside other solids or outside a closed scene: short walks from points all over it, near its corners
/// and edges among them, all come to a side that light does not reach, or leave a scene that no light leaves.
/// Such are the face on which a leg stands and the outer face of a building. Looks only at sides of objects
/// that are reached; a patch has 32 to 512 points, one for 0.01 m2 between.
std::vector<std::uint8_t> findBuriedPatches(const scene::Scene& scene, const rays::RayScene& rays,
                                            const base::Executor& executor, const ReachedSides& reached,
                                            std::uint64_t seed);

}  // namespace fluxwalk::hierarchy
