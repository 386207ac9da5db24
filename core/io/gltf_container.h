#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

/// The outermost layer of a glTF file: which bytes are JSON, which are the binary chunk.
namespace fluxwalk::io {

struct GltfContainer {
    std::vector<std::uint8_t> bytes;  ///< the whole file
    bool isBinary = false;            ///< .glb, by its first bytes and not by its name
    std::string_view json;            ///< into `bytes`
    bool hasBinaryChunk = false;
    std::uint64_t binaryChunkBytes = 0;
};

/// Reads a file and checks the lengths of its header and chunks. Throws base::FileError.
GltfContainer openGltf(const std::filesystem::path& file);

}  // namespace fluxwalk::io
