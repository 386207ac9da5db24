#pragma once

#include <memory>

#include "core/io/gltf_model.h"
#include "core/io/gltf_nodes.h"
#include "core/surface/surface.h"

namespace fluxwalk::io {

/// Whether a node's extras ask for an exact surface instead of its stand-in mesh. What is asked for and not
/// supported becomes a warning, and the stand-in is used.
bool hasExactSurface(GltfModel& model, const PlacedNode& node);

/// The exact surface that `fluxwalk_surface` names (hasExactSurface), with absent sizes from the stand-in's
/// bounds; null (with a warning) where the node's transform or sizes leave it no area or fit no such surface.
std::shared_ptr<const surface::Surface> readExactSurface(GltfModel& model, const PlacedNode& node);

}  // namespace fluxwalk::io
