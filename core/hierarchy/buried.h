#pragma once

#include <cstdint>
#include <vector>

#include "core/hierarchy/reach.h"

namespace fluxwalk::hierarchy {

/// For each patch, in the order of objects, bit 0 where its front and bit 1 where its back lies wholly inside
/// other solids: rays from points all over it, its corners and edges among them, meet nothing first but sides
/// that light does not reach, or leave a scene that no light leaves. Such are the face on which a leg stands
/// and the outer face of a closed building. Looks only at sides of objects that are
/// reached; large patches get more points, so that a gap of some 10 cm counts.
std::vector<std::uint8_t> findBuriedPatches(const scene::Scene& scene, const rays::RayScene& rays,
                                            const base::Executor& executor, const ReachedSides& reached,
                                            std::uint64_t seed);

}  // namespace fluxwalk::hierarchy
