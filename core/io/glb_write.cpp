#include "core/io/glb_write.h"

#include <bit>
#include <string>

namespace fluxwalk::io {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are written in place");

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;

template <class T>
std::span<const std::uint8_t> rawBytes(std::span<const T> values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

void appendWord(std::vector<std::uint8_t>& out, std::uint64_t value) {
    for (int i = 0; i < 4; ++i) {
        out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
}

}  // namespace

std::size_t GlbBuilder::append(const char* section, json item) {
    json& items = root[section];
    items.push_back(std::move(item));
    return items.size() - 1;
}

std::size_t GlbBuilder::addView(std::span<const std::uint8_t> bytes) {
    bin_.resize((bin_.size() + 3) / 4 * 4);
    const std::size_t offset = bin_.size();
    bin_.insert(bin_.end(), bytes.begin(), bytes.end());
    return append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

std::size_t GlbBuilder::addVectors(std::span<const base::Vec2> values) {
    return append("accessors", {{"bufferView", addView(rawBytes(values))},
                                {"componentType", kFloat},
                                {"count", values.size()},
                                {"type", "VEC2"}});
}

std::size_t GlbBuilder::addVectors(std::span<const base::Vec3> values, bool withBounds) {
    json accessor = {{"bufferView", addView(rawBytes(values))},
                     {"componentType", kFloat},
                     {"count", values.size()},
                     {"type", "VEC3"}};
    if (withBounds) {
        base::Vec3 lower = values.front();
        base::Vec3 upper = lower;
        for (const base::Vec3& v : values) {
            lower = glm::min(lower, v);
            upper = glm::max(upper, v);
        }
        accessor["min"] = {lower.x, lower.y, lower.z};
        accessor["max"] = {upper.x, upper.y, upper.z};
    }
    return append("accessors", std::move(accessor));
}

std::size_t GlbBuilder::addIndices(std::span<const std::uint32_t> indices) {
    return append("accessors", {{"bufferView", addView(rawBytes(indices))},
                                {"componentType", kUnsignedInt},
                                {"count", indices.size()},
                                {"type", "SCALAR"}});
}

std::vector<std::uint8_t> GlbBuilder::pack() {
    bin_.resize((bin_.size() + 3) / 4 * 4);
    if (!bin_.empty()) {
        root["buffers"] = {{{"byteLength", bin_.size()}}};
    }
    // Names may hold anything; what is not UTF-8 is replaced rather than refused.
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t length = 12 + 8 + text.size() + (bin_.empty() ? 0 : 8 + bin_.size());
    if (length > 0xffffffffu) {
        return {};
    }
    std::vector<std::uint8_t> out;
    out.reserve(static_cast<std::size_t>(length));
    appendWord(out, 0x46546c67);  // "glTF"
    appendWord(out, 2);
    appendWord(out, length);
    appendWord(out, text.size());
    appendWord(out, 0x4e4f534a);  // "JSON"
    out.insert(out.end(), text.begin(), text.end());
    if (!bin_.empty()) {
        appendWord(out, bin_.size());
        appendWord(out, 0x004e4942);  // "BIN"
        out.insert(out.end(), bin_.begin(), bin_.end());
    }
    return out;
}

}  // namespace fluxwalk::io
