#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace fluxwalk::io {

/// Some channels of a picture, interleaved, rows from the top: floats, the bits of 16-bit floats, or whole
/// numbers.
struct ExrLayer {
    /// Full names in the order of the values: "R", "albedo.G", "object.id".
    std::vector<std::string> channels;
    std::variant<std::span<const float>, std::span<const std::uint16_t>, std::span<const std::uint32_t>>
        values;
    /// Floats are written with 16 bits; those beyond 65,504 become that.
    bool asHalf = false;
};

/// OpenEXR picture of layers, Rec. 709 primaries; its attribute whiteLuminance says that 1 is 1 cd/m2.
std::vector<std::uint8_t> encodeExrLayers(std::uint32_t width, std::uint32_t height,
                                          std::span<const ExrLayer> layers);

/// Writes the same. Throws base::FileError.
void writeExrLayers(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                    std::span<const ExrLayer> layers);

}  // namespace fluxwalk::io
