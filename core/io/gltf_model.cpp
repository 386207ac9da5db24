#include "core/io/gltf_model.h"

#include <cmath>

#include "core/base/error.h"
#include "core/io/file.h"
#include "core/io/gltf_container.h"
#include "core/io/gltf_validate.h"

namespace fluxwalk::io {

namespace {

namespace fs = std::filesystem;

/// What all files that one scene names may have together.
constexpr std::uint64_t kMaxExternalBytes = std::uint64_t{4} << 30;

/// State of the callbacks that tinygltf opens files through.
struct FileAccess {
    fs::path folder;
    std::uint64_t bytesLeft = kMaxExternalBytes;
};

// tinygltf hands over folder and name joined, and tries the working directory next: both must lead inside.
fs::path permitted(const FileAccess& access, const std::string& name) {
    const fs::path relative = fs::path(name).lexically_relative(access.folder);
    return relative.empty() ? fs::path{} : resolveInside(access.folder, relative.string());
}

bool fileExists(const std::string& name, void* context) {
    std::error_code error;
    const fs::path file = permitted(*static_cast<FileAccess*>(context), name);
    return !file.empty() && fs::is_regular_file(file, error);
}

bool readWholeFile(std::vector<unsigned char>* out, std::string* err, const std::string& name,
                   void* context) {
    auto& access = *static_cast<FileAccess*>(context);
    try {
        *out = readFile(permitted(access, name), access.bytesLeft);
    } catch (const base::FileError& e) {
        *err += e.what();
        return false;
    }
    access.bytesLeft -= out->size();
    return true;
}

// The default expands ~ and $(commands).
std::string keepPath(const std::string& name, void* /*context*/) {
    return name;
}

bool refuseToWrite(std::string* /*err*/, const std::string& /*name*/,
                   const std::vector<unsigned char>& /*bytes*/, void* /*context*/) {
    return false;
}

// Decoding comes later, and only for images that a material uses. A view's bytes are unchecked here.
bool keepEncoded(tinygltf::Image* image, int /*index*/, std::string* /*err*/, std::string* /*warn*/,
                 int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*context*/) {
    if (image->bufferView < 0 && size > 0) {
        image->image.assign(bytes, bytes + size);
    }
    return true;
}

std::string firstLine(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    return line.empty() ? "cannot be parsed" : line;
}

}  // namespace

void GltfModel::fail(const std::string& place, const std::string& message) const {
    throw base::FileError(file, place, message);
}

std::span<const std::uint8_t> GltfModel::view(int bufferView, const std::string& place) const {
    const tinygltf::BufferView& v = at(data.bufferViews, bufferView, place);
    const tinygltf::Buffer& buffer = at(data.buffers, v.buffer, place);
    if (v.byteOffset > buffer.data.size() || v.byteLength > buffer.data.size() - v.byteOffset) {
        fail(place, "buffer view " + std::to_string(bufferView) + " leaves its buffer");
    }
    return std::span(buffer.data).subspan(v.byteOffset, v.byteLength);
}

GltfModel loadGltf(const fs::path& file) {
    const GltfContainer container = openGltf(file);
    validateGltf(file, container);

    GltfModel model;
    model.file = file.string();
    FileAccess access{sceneFolder(file)};
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({fileExists, keepPath, readWholeFile, refuseToWrite, &access});
    parser.SetImageLoader(keepEncoded, nullptr);
    std::string err;
    std::string warn;
    bool ok = false;
    try {
        const std::string folder = access.folder.string();
        const auto size = static_cast<unsigned int>(container.bytes.size());
        ok = container.isBinary
                 ? parser.LoadBinaryFromMemory(&model.data, &err, &warn, container.bytes.data(), size, folder)
                 : parser.LoadASCIIFromString(&model.data, &err, &warn,
                                              reinterpret_cast<const char*>(container.bytes.data()), size,
                                              folder);
    } catch (const std::exception& e) {
        err = e.what();
    }
    if (!ok) {
        model.fail("", firstLine(err));
    }
    return model;
}

const tinygltf::Value* findValue(const tinygltf::Value& owner, const std::string& key) {
    return owner.Has(key) ? &owner.Get(key) : nullptr;
}

std::optional<double> findNumber(const tinygltf::Value& owner, const std::string& key) {
    const tinygltf::Value* value = findValue(owner, key);
    if (value == nullptr || !value->IsNumber() || !std::isfinite(value->GetNumberAsDouble())) {
        return std::nullopt;
    }
    return value->GetNumberAsDouble();
}

std::optional<int> findIndex(const tinygltf::Value& owner, const std::string& key) {
    const std::optional<double> number = findNumber(owner, key);
    // Blender writes whole numbers as reals where the property is one.
    if (!number || *number < 0.0 || *number > 1e9 || *number != std::floor(*number)) {
        return std::nullopt;
    }
    return static_cast<int>(*number);
}

std::optional<bool> findBool(const tinygltf::Value& owner, const std::string& key) {
    const tinygltf::Value* value = findValue(owner, key);
    if (value != nullptr && value->IsBool()) {
        return value->Get<bool>();
    }
    // Blender's older custom properties know only 0 and 1.
    if (const std::optional<double> number = findNumber(owner, key)) {
        return *number != 0.0;
    }
    return std::nullopt;
}

std::string findString(const tinygltf::Value& owner, const std::string& key) {
    const tinygltf::Value* value = findValue(owner, key);
    return value != nullptr && value->IsString() ? value->Get<std::string>() : std::string();
}

std::vector<double> findNumbers(const tinygltf::Value& owner, const std::string& key, std::size_t length) {
    const tinygltf::Value* value = findValue(owner, key);
    if (value == nullptr || !value->IsArray() || value->ArrayLen() != length) {
        return {};
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < length; ++i) {
        const tinygltf::Value& item = value->Get(static_cast<int>(i));
        if (!item.IsNumber() || !std::isfinite(item.GetNumberAsDouble())) {
            return {};
        }
        numbers.push_back(item.GetNumberAsDouble());
    }
    return numbers;
}

const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

}  // namespace fluxwalk::io
