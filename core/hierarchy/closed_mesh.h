#pragma once

#include "core/surface/surface.h"

namespace fluxwalk::hierarchy {

/// Whether a surface is a polygon mesh of closed parts (every edge has two faces that run along it in
/// opposite directions), each with its fronts outwards: what is behind a face is then inside, and no light
/// comes there but from an emitter inside. Meshes that pierce themselves are not told apart.
bool isClosedOutwards(const surface::Surface& surface);

}  // namespace fluxwalk::hierarchy
