#pragma once

#include <vector>

#include "core/scene/lit_mesh.h"
#include "core/scene/scene.h"
#include "core/scene/texture.h"

namespace fluxwalk::io {

/// Exitance in lm/m2 of every vertex of a lit mesh: reflected irradiance, and emission where this side emits.
/// Without `withTexture` the reflectance texture is left out (it is multiplied by whoever draws).
std::vector<base::Rgb> vertexExitance(const scene::Scene& scene, const scene::TextureSet& textures,
                                      const scene::LitMesh& mesh, bool withTexture);

}  // namespace fluxwalk::io
