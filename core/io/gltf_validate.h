#pragma once

#include <filesystem>
#include <string>

#include "core/io/gltf_container.h"

/// Checks of the JSON that tinygltf omits (it accepts any index, range and type, and opens any path), made
/// before it sees the file.
namespace fluxwalk::io {

/// Throws base::FileError with a JSON pointer where an index has no target, a number is not what it must be,
/// a range leaves its buffer, a URI leaves the folder, or an extension is required that we lack. Afterwards
/// every reference between buffers, views, accessors, images, textures, materials, meshes and nodes holds.
void validateGltf(const std::filesystem::path& file, const GltfContainer& container);

/// The folder that a scene's file lies in, symbolic links followed.
std::filesystem::path sceneFolder(const std::filesystem::path& file);

/// The file that a relative path (a URI, percent signs decoded) names, symbolic links followed; empty where
/// it lies outside `folder` or is no relative path.
std::filesystem::path resolveInside(const std::filesystem::path& folder, const std::string& name);

}  // namespace fluxwalk::io
