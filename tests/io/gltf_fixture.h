#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/vec.h"
#include "core/io/gltf_read.h"

/// glTF files made by code, in a folder of their own that is removed afterwards.
namespace fluxwalk::test {

using nlohmann::json;

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "fluxwalk-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline void writeBytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes) {
    // Truncating a file that exists makes some file systems flush it.
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline std::vector<std::uint8_t> bytesOf(const std::string& text) {
    return {text.begin(), text.end()};
}

/// JSON and binary chunk of a file; starts with an empty scene.
class GltfFixture {
  public:
    json root = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::uint8_t> bin;

    /// Appends raw data, aligned to 4 bytes, and a view of it; returns the view's index.
    template <class T>
    int addView(const std::vector<T>& values, int byteStride = 0) {
        bin.resize((bin.size() + 3) / 4 * 4);
        const std::size_t offset = bin.size();
        bin.resize(offset + values.size() * sizeof(T));
        std::memcpy(bin.data() + offset, values.data(), values.size() * sizeof(T));
        json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}};
        if (byteStride != 0) {
            view["byteStride"] = byteStride;
        }
        return add("bufferViews", view);
    }

    int addAccessor(int view, int componentType, std::size_t count, const char* type) {
        json accessor = {{"componentType", componentType}, {"count", count}, {"type", type}};
        if (view >= 0) {
            accessor["bufferView"] = view;
        }
        return add("accessors", accessor);
    }

    int addFloats(const std::vector<float>& values, const char* type, std::size_t components) {
        return addAccessor(addView(values), 5126, values.size() / components, type);
    }
    int addPositions(const std::vector<float>& xyz) { return addFloats(xyz, "VEC3", 3); }
    int addTexcoords(const std::vector<float>& uv) { return addFloats(uv, "VEC2", 2); }
    int addIndices(const std::vector<std::uint16_t>& indices) {
        return addAccessor(addView(indices), 5123, indices.size(), "SCALAR");
    }

    int addMesh(const json& primitive) { return add("meshes", {{"primitives", {primitive}}}); }
    int addNode(const json& node) { return add("nodes", node); }

    /// The unit square in z = 0, facing +z, as a mesh of two triangles; `more` is merged into its primitive.
    int addSquare(const json& more = json::object()) {
        json primitive = {{"attributes",
                           {{"POSITION", addPositions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})},
                            {"TEXCOORD_0", addTexcoords({0, 1, 1, 1, 1, 0, 0, 0})}}},
                          {"indices", addIndices({0, 1, 2, 0, 2, 3})}};
        primitive.update(more);
        return addMesh(primitive);
    }

    /// A picture embedded as PNG bytes and a texture of it; returns the texture's index.
    int addTexture(const std::vector<std::uint8_t>& encoded, const json& more = json::object()) {
        const int image = add("images", {{"bufferView", addView(encoded)}, {"mimeType", "image/png"}});
        json texture = {{"source", image}};
        texture.update(more);
        return add("textures", texture);
    }

    int add(const char* section, const json& item) {
        root[section].push_back(item);
        return static_cast<int>(root[section].size()) - 1;
    }

    std::vector<std::uint8_t> glb() const {
        json document = root;
        std::vector<std::uint8_t> chunk = bin;
        chunk.resize((chunk.size() + 3) / 4 * 4);
        if (!chunk.empty() && !document.contains("buffers")) {
            document["buffers"] = {{{"byteLength", chunk.size()}}};
        }
        return packGlb(document.dump(), chunk);
    }

    static std::vector<std::uint8_t> packGlb(std::string text, const std::vector<std::uint8_t>& chunk) {
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::uint8_t> out;
        const auto word = [&out](std::size_t value) {
            for (int i = 0; i < 4; ++i) {
                out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
            }
        };
        word(0x46546c67);
        word(2);
        word(20 + text.size() + (chunk.empty() ? 0 : 8 + chunk.size()));
        word(text.size());
        word(0x4e4f534a);
        out.insert(out.end(), text.begin(), text.end());
        if (!chunk.empty()) {
            word(chunk.size());
            word(0x004e4942);
            out.insert(out.end(), chunk.begin(), chunk.end());
        }
        return out;
    }

    scene::Scene read(const TemporaryFolder& folder) const {
        const std::filesystem::path file = folder.path() / "scene.glb";
        writeBytes(file, glb());
        return io::readGltf(file);
    }
};

/// what() of the FileError that reading throws; "no error" where it throws none.
inline std::string errorOf(const std::filesystem::path& file) {
    try {
        io::readGltf(file);
    } catch (const base::FileError& e) {
        return e.what();
    }
    return "no error";
}

inline std::string errorOf(const GltfFixture& fixture, const TemporaryFolder& folder) {
    const std::filesystem::path file = folder.path() / "scene.glb";
    writeBytes(file, fixture.glb());
    return errorOf(file);
}

inline bool hasWarning(const scene::Scene& scene, const std::string& part) {
    for (const std::string& line : scene.warnings) {
        if (line.find(part) != std::string::npos) {
            return true;
        }
    }
    return false;
}

}  // namespace fluxwalk::test
