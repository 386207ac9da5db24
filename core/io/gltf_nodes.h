#pragma once

#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/io/gltf_model.h"

namespace fluxwalk::io {

/// A node of the scene with its place in the world.
struct PlacedNode {
    int index = 0;
    std::string place;  ///< "/nodes/3 'lamp'"
    base::Mat4d worldFromNode{1.0};
};

/// The nodes of the file's scene (its default one, else the first, else all), parents before children. Throws
/// base::FileError for cycles, nodes with two parents and rotations of length zero.
std::vector<PlacedNode> placeNodes(const GltfModel& model);

/// Name of a placed node, of what it holds, or its number: for objects, lights and cameras.
std::string nameOf(const GltfModel& model, const PlacedNode& node, const std::string& content);

}  // namespace fluxwalk::io
