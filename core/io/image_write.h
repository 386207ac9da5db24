#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace fluxwalk::io {

/// PNG of 8-bit pixels, rows from the top, `channels` 3 (RGB) or 4 (RGBA) bytes each.
std::vector<std::uint8_t> encodePng(std::uint32_t width, std::uint32_t height, unsigned channels,
                                    std::span<const std::uint8_t> pixels);

/// Writes 8-bit sRGB pixels, rows from the top, three bytes each. Throws base::FileError.
void writePng(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb);

}  // namespace fluxwalk::io
