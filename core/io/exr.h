#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace fluxwalk::io {

/// OpenEXR picture of linear light in cd/m2, Rec. 709 primaries: floats, three a pixel (RGB), rows from the
/// top. The file says by its attribute whiteLuminance that 1 is 1 cd/m2.
std::vector<std::uint8_t> encodeExr(std::uint32_t width, std::uint32_t height, std::span<const float> light);

/// Writes the same. Throws base::FileError.
void writeExr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const float> light);

}  // namespace fluxwalk::io
