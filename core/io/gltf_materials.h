#pragma once

#include "core/io/gltf_images.h"
#include "core/io/gltf_model.h"
#include "core/scene/scene.h"

namespace fluxwalk::io {

/// Reads all materials into Scene::materials, in the file's order, and decodes the images they use.
/// Reflectance is the base colour, emission pi times the emissive luminance; what a diffuse material cannot
/// express becomes a warning.
void readMaterials(GltfModel& model, scene::Scene& scene);

}  // namespace fluxwalk::io
