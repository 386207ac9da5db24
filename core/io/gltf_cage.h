#pragma once

#include <memory>

#include "core/io/gltf_model.h"
#include "core/io/gltf_nodes.h"
#include "core/scene/material.h"
#include "core/surface/surface.h"

namespace fluxwalk::io {

/// Faces of one control cage: each may take 100 kB.
inline constexpr std::size_t kMaxCageFaces = std::size_t{1} << 16;

/// Whether a node's extras say that its mesh is a control cage (`fluxwalk_subdivision`). Schemes that are not
/// known become a warning.
bool isControlCage(GltfModel& model, const PlacedNode& node);

/// The limit surface of a node's mesh, all primitives together, with the texture coordinates that `material`
/// uses; null (with a warning) where the mesh is no control cage. `trianglesLeft` is as for readPrimitive.
/// Throws base::FileError.
std::shared_ptr<const surface::Surface> readSubdivision(GltfModel& model, const PlacedNode& node,
                                                        const scene::Material& material,
                                                        std::uint64_t& trianglesLeft);

}  // namespace fluxwalk::io
