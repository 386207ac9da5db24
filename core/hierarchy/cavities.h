#pragma once

#include <cstdint>
#include <vector>

#include "core/hierarchy/reach.h"

namespace fluxwalk::hierarchy {

/// For each patch, in the order of objects, bit 0 where its front and bit 1 where its back belongs to a
/// cavity into which no light leads, though light reaches other parts of the same side of its object: the
/// space within a flight of stairs, the inside of a cupboard that is shut. Walks of light join the patches
/// that they lead from and to; a cavity is a set of patches so joined that holds no emitter and from which,
/// of a hundred walks from each patch, none sees a light or leaves an open scene. Looks only at patches that
/// are reached.
std::vector<std::uint8_t> findCavities(const scene::Scene& scene, const rays::RayScene& rays,
                                       const base::Executor& executor, const ReachedSides& reached,
                                       std::uint64_t seed);

}  // namespace fluxwalk::hierarchy
