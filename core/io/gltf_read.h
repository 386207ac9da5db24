#pragma once

#include <filesystem>

#include "core/scene/scene.h"

namespace fluxwalk::io {

/// Reads a .glb or .gltf file (DESIGN section 8). Throws base::FileError with file and JSON pointer; what can
/// be worked around becomes a line of Scene::warnings. Never reads outside the file's folder.
scene::Scene readGltf(const std::filesystem::path& file);

}  // namespace fluxwalk::io
