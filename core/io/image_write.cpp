#include "core/io/image_write.h"

#include <stb/stb_image_write.h>

#include "core/base/check.h"
#include "core/io/file.h"

namespace fluxwalk::io {

namespace {

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

std::vector<std::uint8_t> encodePng(std::uint32_t width, std::uint32_t height, unsigned channels,
                                    std::span<const std::uint8_t> pixels) {
    FLUXWALK_CHECK_EQ(pixels.size(), std::size_t{channels} * width * height);
    FLUXWALK_CHECK_LT(0u, pixels.size());
    std::vector<std::uint8_t> bytes;
    const int ok =
        stbi_write_png_to_func(append, &bytes, static_cast<int>(width), static_cast<int>(height),
                               static_cast<int>(channels), pixels.data(), static_cast<int>(channels * width));
    FLUXWALK_CHECK(ok != 0);
    return bytes;
}

void writePng(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb) {
    writeFile(file, encodePng(width, height, 3, rgb));
}

}  // namespace fluxwalk::io
