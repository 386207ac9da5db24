#include "core/io/gltf_images.h"

#include <array>
#include <cstring>
#include <memory>

#include <stb/stb_image.h>

namespace fluxwalk::io {

namespace {

/// Pixels of one picture (16,384 squared) and of all together: some bytes of PNG can claim any size.
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;
constexpr std::uint64_t kMaxPixelsTogether = std::uint64_t{1} << 29;
/// sRGB of linear 0.5, the reflectance of a material that says nothing.
constexpr std::uint8_t kMidGrey = 188;

// glTF knows these two; stb's other decoders stay out of reach of files.
bool isPngOrJpeg(std::span<const std::uint8_t> bytes) {
    constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<std::uint8_t, 3> kJpeg{0xff, 0xd8, 0xff};
    const auto startsWith = [bytes](const auto& magic) {
        return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
    };
    return startsWith(kPng) || startsWith(kJpeg);
}

}  // namespace

ImageTable::ImageTable(GltfModel& model, scene::Scene& scene)
    : model_(model), scene_(scene), decoded_(model.data.images.size(), -1), pixelsLeft_(kMaxPixelsTogether) {}

std::int32_t ImageTable::add(scene::Image image) {
    scene_.images.push_back(std::move(image));
    return static_cast<std::int32_t>(scene_.images.size() - 1);
}

std::int32_t ImageTable::addGrey(const std::string& place, const std::string& why) {
    model_.warnings.add("the image " + why + "; mid grey is used instead", place);
    return add({"mid grey", 1, 1, {kMidGrey, kMidGrey, kMidGrey, 255}});
}

std::int32_t ImageTable::imageOf(int texture, const std::string& place) {
    const int source = model_.at(model_.data.textures, texture, place).source;
    if (source < 0) {
        return addGrey("/textures/" + std::to_string(texture), "is of a kind that is not supported");
    }
    const std::string imagePlace = "/images/" + std::to_string(source);
    const tinygltf::Image& encoded = model_.at(model_.data.images, source, imagePlace);
    std::int32_t& index = decoded_[static_cast<std::size_t>(source)];
    if (index >= 0) {
        return index;
    }
    const std::string name = encoded.name.empty() ? encoded.uri : encoded.name;
    const std::span<const std::uint8_t> bytes =
        encoded.bufferView >= 0 ? model_.view(encoded.bufferView, imagePlace) : std::span(encoded.image);
    if (bytes.empty()) {
        return index = addGrey(imagePlace, "'" + name + "' cannot be read");
    }
    const auto size = static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff));
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!isPngOrJpeg(bytes)) {
        return index = addGrey(imagePlace, "'" + name + "' is neither PNG nor JPEG");
    }
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 || width < 1 ||
        height < 1) {
        return index = addGrey(imagePlace, "'" + name + "' cannot be decoded");
    }
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (pixels > kMaxPixels || pixels > pixelsLeft_) {
        return index = addGrey(imagePlace, "'" + name + "' is too large (" + std::to_string(width) + " x " +
                                               std::to_string(height) + ")");
    }
    // 16-bit pictures come back reduced to 8 bits.
    const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!rgba) {
        return index = addGrey(imagePlace, "'" + name + "' cannot be decoded");
    }
    pixelsLeft_ -= pixels;
    return index = add({name, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                        std::vector<std::uint8_t>(rgba.get(), rgba.get() + 4 * pixels)});
}

}  // namespace fluxwalk::io
