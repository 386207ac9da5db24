#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace fluxwalk::io {

/// A scene as a .glb that readGltf takes for the same: exact surfaces as nodes with a stand-in mesh and
/// `fluxwalk_` extras (DESIGN section 8), control cages as their meshes, polygon meshes with the corners of
/// each patch. Everything else is as any glTF viewer expects it. The scene has neither lights without area
/// nor a sky, and no creases in its cages.
std::vector<std::uint8_t> packSceneGltf(const scene::Scene& scene);

}  // namespace fluxwalk::io
