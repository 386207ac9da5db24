#include "core/io/gltf_container.h"

#include <string>

#include "core/base/error.h"
#include "core/io/file.h"

namespace fluxwalk::io {

namespace {

constexpr std::uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004e4942;   // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

// Little-endian, whatever the machine.
std::uint32_t wordAt(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) {
        word = (word << 8) | bytes[offset + i];
    }
    return word;
}

}  // namespace

GltfContainer openGltf(const std::filesystem::path& file) {
    const auto fail = [&file](const std::string& message) {
        throw base::FileError(file.string(), "", message);
    };
    GltfContainer c;
    c.bytes = readFile(file);
    const auto* text = reinterpret_cast<const char*>(c.bytes.data());
    c.isBinary = c.bytes.size() >= 4 && wordAt(c.bytes, 0) == kMagic;
    if (!c.isBinary) {
        c.json = {text, c.bytes.size()};
        const std::size_t first = c.json.find_first_not_of(" \t\r\n\xef\xbb\xbf");
        if (first == std::string_view::npos || c.json[first] != '{') {
            fail("is neither binary glTF nor JSON");
        }
        return c;
    }
    if (c.bytes.size() < kHeaderBytes + kChunkHeaderBytes) {
        fail("is truncated: the header of binary glTF is incomplete");
    }
    if (wordAt(c.bytes, 4) != 2) {
        fail("is binary glTF of version " + std::to_string(wordAt(c.bytes, 4)) + ", only 2 is supported");
    }
    const std::uint64_t length = wordAt(c.bytes, 8);
    if (length > c.bytes.size()) {
        fail("is truncated: its header says " + std::to_string(length) + " bytes, it has " +
             std::to_string(c.bytes.size()));
    }
    const std::uint64_t jsonBytes = wordAt(c.bytes, 12);
    const std::uint64_t jsonEnd = kHeaderBytes + kChunkHeaderBytes + jsonBytes;
    if (wordAt(c.bytes, 16) != kJsonChunk || jsonEnd > length) {
        fail("is damaged: the first chunk is not JSON or is longer than the file");
    }
    c.json = {text + kHeaderBytes + kChunkHeaderBytes, static_cast<std::size_t>(jsonBytes)};
    if (jsonEnd == length) {
        return c;
    }
    if (jsonEnd + kChunkHeaderBytes > length) {
        fail("is truncated: the header of its second chunk is incomplete");
    }
    c.binaryChunkBytes = wordAt(c.bytes, static_cast<std::size_t>(jsonEnd));
    c.hasBinaryChunk = wordAt(c.bytes, static_cast<std::size_t>(jsonEnd) + 4) == kBinChunk;
    if (!c.hasBinaryChunk || jsonEnd + kChunkHeaderBytes + c.binaryChunkBytes > length) {
        fail("is damaged: the second chunk is not binary or is longer than the file");
    }
    return c;
}

}  // namespace fluxwalk::io
