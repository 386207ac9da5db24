#pragma once

#include <cstdint>
#include <optional>

#include "core/io/gltf_model.h"
#include "core/io/gltf_nodes.h"
#include "core/scene/scene.h"
#include "core/surface/polygon_mesh.h"

namespace fluxwalk::io {

/// Triangles of all objects together: what 128 GiB can solve, and far less than a damaged file can ask for.
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 26;

/// One primitive in world space, with the texture coordinates that `material` uses, or nothing (with a
/// warning) where it has no triangles. `trianglesLeft` is what remains of kMaxTriangles. Throws
/// base::FileError.
std::optional<surface::TriangleSoup> readPrimitive(GltfModel& model, const PlacedNode& node, int primitive,
                                                   const scene::Material& material,
                                                   std::uint64_t& trianglesLeft);

/// The vertices of a primitive's corners in order, each checked to be below `vertexCount`.
std::vector<std::uint32_t> readCorners(const GltfModel& model, const tinygltf::Primitive& primitive,
                                       std::size_t vertexCount);

/// Bounds of a primitive's vertices in the node's own space.
base::Box localBounds(const GltfModel& model, const PlacedNode& node, int primitive);

}  // namespace fluxwalk::io
