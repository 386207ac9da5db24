#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "core/io/warnings.h"

/// A parsed and validated glTF file, and checked access to the parts that tinygltf leaves generic.
namespace fluxwalk::io {

struct GltfModel {
    std::string file;
    tinygltf::Model data;
    Warnings warnings;

    [[noreturn]] void fail(const std::string& place, const std::string& message) const;

    /// Bytes of a buffer view.
    std::span<const std::uint8_t> view(int bufferView, const std::string& place) const;

    /// Item of an array by an index from the file, which validateGltf has seen unless it comes from an
    /// extension.
    template <class T>
    const T& at(const std::vector<T>& items, int index, const std::string& place) const {
        if (index < 0 || static_cast<std::size_t>(index) >= items.size()) {
            fail(place, "index " + std::to_string(index) + " is out of range");
        }
        return items[static_cast<std::size_t>(index)];
    }
};

/// Opens, validates and parses a file and the buffers and encoded images it names. Images stay encoded in
/// tinygltf::Image::image (empty for those in buffer views and those that cannot be read). Throws
/// base::FileError.
GltfModel loadGltf(const std::filesystem::path& file);

/// Values of extras and extensions, absent where the key or its type is not as expected.
const tinygltf::Value* findValue(const tinygltf::Value& owner, const std::string& key);
std::optional<double> findNumber(const tinygltf::Value& owner, const std::string& key);
std::optional<int> findIndex(const tinygltf::Value& owner, const std::string& key);
std::optional<bool> findBool(const tinygltf::Value& owner, const std::string& key);
std::string findString(const tinygltf::Value& owner, const std::string& key);
/// Exactly `length` finite numbers, or none.
std::vector<double> findNumbers(const tinygltf::Value& owner, const std::string& key, std::size_t length);
/// Number of a file as float; those out of its range become large but finite.
inline float toFloat(double value) {
    return static_cast<float>(std::clamp(value, -1e30, 1e30));
}
/// An extension of some part; null where it is absent or no object.
const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const std::string& name);

}  // namespace fluxwalk::io
