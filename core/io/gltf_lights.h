#pragma once

#include "core/io/gltf_model.h"
#include "core/io/gltf_nodes.h"
#include "core/scene/scene.h"

namespace fluxwalk::io {

/// Appends the KHR_lights_punctual light of a node, where it has one.
void readLight(GltfModel& model, const PlacedNode& node, scene::Scene& scene);

/// Appends the perspective camera of a node, where it has one.
void readCamera(GltfModel& model, const PlacedNode& node, scene::Scene& scene);

}  // namespace fluxwalk::io
