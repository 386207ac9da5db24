#include "core/io/gltf_validate.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/json_checks.h"

namespace fluxwalk::io {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Deeper JSON than any real file's; tinygltf recurses, and so do we.
constexpr int kMaxDepth = 64;

constexpr std::array<std::string_view, 5> kKnownExtensions{
    "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_mesh_quantization",
    "KHR_texture_transform"};

std::string percentDecode(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        if (text[i] == '%' && i + 2 < text.size()) {
            const char* first = text.data() + i + 1;
            const auto [end, error] = std::from_chars(first, first + 2, value, 16);
            if (error == std::errc{} && end == first + 2) {
                result.push_back(static_cast<char>(value));
                i += 2;
                continue;
            }
        }
        result.push_back(text[i]);
    }
    return result;
}

int depthOf(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                inString = false;
            }
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

json parseDocument(const fs::path& file, std::string_view text) {
    if (depthOf(text) > kMaxDepth) {
        throw base::FileError(file.string(), "",
                              "is nested deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    json root;
    try {
        root = json::parse(text);
    } catch (const json::exception& e) {
        throw base::FileError(file.string(), "", "is not valid JSON: " + std::string(e.what()));
    }
    if (!root.is_object()) {
        throw base::FileError(file.string(), "", "the top level of the JSON is not an object");
    }
    return root;
}

class Validator : private JsonChecks {
  public:
    Validator(const fs::path& file, const GltfContainer& container, const json& root)
        : JsonChecks(file.string(), root), folder_(sceneFolder(file)), container_(container) {}

    void run() {
        for (const char* section :
             {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials", "meshes",
              "nodes", "samplers", "scenes", "skins", "textures"}) {
            forEach(root(), section, "", [](const json&, const std::string&) {});
        }
        checkAsset();
        checkBuffers();
        checkAccessors();
        checkPictures();
        checkMaterials();
        checkMeshes();
        checkNodes();
    }

  private:
    void checkUri(const json& owner, const std::string& place) const {
        const auto found = owner.find("uri");
        if (found == owner.end()) {
            return;
        }
        if (!found->is_string()) {
            fail(place + "/uri", "is not a string");
        }
        const auto& uri = found->get_ref<const std::string&>();
        if (!uri.starts_with("data:") && resolveInside(folder_, percentDecode(uri)).empty()) {
            fail(place + "/uri", "'" + uri + "' is not a path inside the scene's folder");
        }
    }

    void checkAsset() const {
        const auto asset = root().find("asset");
        const bool hasVersion =
            asset != root().end() && asset->is_object() && asset->value("version", json()).is_string();
        if (!hasVersion) {
            fail("/asset/version", "is missing: this is not glTF 2.0");
        }
        const std::string version = (*asset)["version"];
        if (!version.starts_with("2.")) {
            fail("/asset/version", "is " + version + ", only 2.x is supported");
        }
        const auto required = root().find("extensionsRequired");
        if (required == root().end()) {
            return;
        }
        if (!required->is_array()) {
            fail("/extensionsRequired", "is not an array");
        }
        for (std::size_t i = 0; i < required->size(); ++i) {
            const json& name = (*required)[i];
            const bool isKnown =
                name.is_string() && std::find(kKnownExtensions.begin(), kKnownExtensions.end(),
                                              name.get<std::string>()) != kKnownExtensions.end();
            if (!isKnown) {
                fail("/extensionsRequired/" + std::to_string(i),
                     "the file requires " + name.dump() + ", which is not supported");
            }
        }
    }

    void checkBuffers() {
        forEach(root(), "buffers", "", [this](const json& buffer, const std::string& place) {
            require(buffer, "byteLength", place);
            const std::uint64_t length = count(buffer, "byteLength", place, 0, 1, 0xffffffffu);
            checkUri(buffer, place);
            if (!buffer.contains("uri")) {
                // Only the first may stand for the binary chunk; tinygltf would copy it once for each.
                if (!container_.hasBinaryChunk || !bufferLengths_.empty()) {
                    fail(place, "has no data: neither a uri nor the file's binary chunk");
                }
                if (length > container_.binaryChunkBytes) {
                    fail(place + "/byteLength", std::to_string(length) +
                                                    " is more than the binary chunk has: " +
                                                    std::to_string(container_.binaryChunkBytes));
                }
            }
            bufferLengths_.push_back(length);
        });
        forEach(root(), "bufferViews", "", [this](const json& view, const std::string& place) {
            require(view, "buffer", place);
            require(view, "byteLength", place);
            checkIndex(view, "buffer", "buffers", place);
            const std::uint64_t length = count(view, "byteLength", place, 0, 1, 0xffffffffu);
            const std::uint64_t offset = count(view, "byteOffset", place, 0, 0, 0xffffffffu);
            const std::uint64_t available = bufferLengths_[view["buffer"].get<std::size_t>()];
            if (offset + length > available) {
                fail(place, "ends at byte " + std::to_string(offset + length) + " of a buffer that has " +
                                std::to_string(available));
            }
            if (count(view, "byteStride", place, 4, 4, 252) % 4 != 0) {
                fail(place + "/byteStride", "is not a multiple of 4");
            }
        });
    }

    void checkAccessors() const {
        forEach(root(), "accessors", "", [this](const json& accessor, const std::string& place) {
            for (const char* key : {"componentType", "count", "type"}) {
                require(accessor, key, place);
            }
            checkIndex(accessor, "bufferView", "bufferViews", place);
            count(accessor, "count", place, 1, 1, 0xffffffffu);
            count(accessor, "byteOffset", place, 0, 0, 0xffffffffu);
            count(accessor, "componentType", place, 5126, 5120, 5126);
            const auto sparse = accessor.find("sparse");
            if (sparse == accessor.end()) {
                return;
            }
            if (!sparse->is_object()) {
                fail(place + "/sparse", "is not an object");
            }
            require(*sparse, "count", place + "/sparse");
            count(*sparse, "count", place + "/sparse", 1, 1, 0x7fffffffu);
            for (const char* part : {"indices", "values"}) {
                const std::string partPlace = place + "/sparse/" + part;
                require(*sparse, part, place + "/sparse");
                const json& data = (*sparse)[part];
                if (!data.is_object()) {
                    fail(partPlace, "is not an object");
                }
                require(data, "bufferView", partPlace);
                checkIndex(data, "bufferView", "bufferViews", partPlace);
                count(data, "byteOffset", partPlace, 0, 0, 0x7fffffffu);
                count(data, "componentType", partPlace, 5121, 5120, 5126);
            }
        });
    }

    void checkPictures() const {
        forEach(root(), "images", "", [this](const json& image, const std::string& place) {
            checkIndex(image, "bufferView", "bufferViews", place);
            checkUri(image, place);
            if (image.contains("uri") == image.contains("bufferView")) {
                fail(place, "must have either a uri or a bufferView");
            }
        });
        forEach(root(), "textures", "", [this](const json& texture, const std::string& place) {
            checkIndex(texture, "source", "images", place);
            checkIndex(texture, "sampler", "samplers", place);
        });
    }

    void checkTextureInfo(const json& owner, const char* key, const std::string& place) const {
        const auto info = owner.find(key);
        if (info == owner.end()) {
            return;
        }
        const std::string infoPlace = place + "/" + key;
        if (!info->is_object()) {
            fail(infoPlace, "is not an object");
        }
        require(*info, "index", infoPlace);
        checkIndex(*info, "index", "textures", infoPlace);
        count(*info, "texCoord", infoPlace, 0, 0, 255);
    }

    void checkMaterials() const {
        forEach(root(), "materials", "", [this](const json& material, const std::string& place) {
            checkNumbers(material, "emissiveFactor", 3, place);
            for (const char* key : {"emissiveTexture", "normalTexture", "occlusionTexture"}) {
                checkTextureInfo(material, key, place);
            }
            const auto pbr = material.find("pbrMetallicRoughness");
            if (pbr == material.end()) {
                return;
            }
            const std::string pbrPlace = place + "/pbrMetallicRoughness";
            if (!pbr->is_object()) {
                fail(pbrPlace, "is not an object");
            }
            checkNumbers(*pbr, "baseColorFactor", 4, pbrPlace);
            checkTextureInfo(*pbr, "baseColorTexture", pbrPlace);
            checkTextureInfo(*pbr, "metallicRoughnessTexture", pbrPlace);
        });
    }

    void checkMeshes() const {
        forEach(root(), "meshes", "", [this](const json& mesh, const std::string& place) {
            require(mesh, "primitives", place);
            forEach(mesh, "primitives", place, [this](const json& primitive, const std::string& part) {
                checkIndex(primitive, "indices", "accessors", part);
                checkIndex(primitive, "material", "materials", part);
                count(primitive, "mode", part, 4, 0, 6);
                require(primitive, "attributes", part);
                const json& attributes = primitive["attributes"];
                if (!attributes.is_object()) {
                    fail(part + "/attributes", "is not an object");
                }
                for (const auto& [name, accessor] : attributes.items()) {
                    checkTarget(accessor, "accessors", std::string(part).append("/attributes/").append(name));
                }
            });
        });
    }

    // tinygltf drops what is null, so that it would pass for absent.
    void checkExtras(const json& node, const std::string& place) const {
        const auto extras = node.find("extras");
        if (extras == node.end() || !extras->is_object()) {
            return;
        }
        for (const auto& [name, value] : extras->items()) {
            if (name.starts_with("fluxwalk_") && value.is_null()) {
                fail(std::string(place).append("/extras/").append(name), "is null");
            }
        }
    }

    void checkNodes() const {
        forEach(root(), "nodes", "", [this](const json& node, const std::string& place) {
            checkIndex(node, "mesh", "meshes", place);
            checkIndex(node, "camera", "cameras", place);
            checkIndex(node, "skin", "skins", place);
            checkIndices(node, "children", "nodes", place);
            checkNumbers(node, "translation", 3, place);
            checkNumbers(node, "rotation", 4, place);
            checkNumbers(node, "scale", 3, place);
            checkNumbers(node, "matrix", 16, place);
            checkExtras(node, place);
        });
        forEach(root(), "scenes", "", [this](const json& scene, const std::string& place) {
            checkIndices(scene, "nodes", "nodes", place);
        });
        checkIndex(root(), "scene", "scenes", "");
    }

    fs::path folder_;
    const GltfContainer& container_;
    std::vector<std::uint64_t> bufferLengths_;
};

}  // namespace

fs::path sceneFolder(const fs::path& file) {
    std::error_code error;
    const fs::path parent = file.parent_path();
    return fs::weakly_canonical(parent.empty() ? fs::path(".") : parent, error);
}

fs::path resolveInside(const fs::path& folder, const std::string& name) {
    const fs::path relative(name);
    // A scheme is one letter or more before a colon; no file of a scene needs one in its name.
    const bool hasScheme = name.find(':') < name.find('/');
    if (name.empty() || name.find('\0') != std::string::npos || hasScheme || relative.is_absolute()) {
        return {};
    }
    std::error_code error;
    const fs::path target = fs::weakly_canonical(folder / relative, error);
    if (error) {
        return {};
    }
    const auto [inFolder, inTarget] =
        std::mismatch(folder.begin(), folder.end(), target.begin(), target.end());
    return inFolder == folder.end() && inTarget != target.end() ? target : fs::path{};
}

void validateGltf(const fs::path& file, const GltfContainer& container) {
    const json root = parseDocument(file, container.json);
    Validator(file, container, root).run();
}

}  // namespace fluxwalk::io
