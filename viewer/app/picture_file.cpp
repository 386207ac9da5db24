#include "viewer/app/picture_file.h"

#include <algorithm>
#include <string>

#include "core/base/error.h"
#include "core/io/exr.h"
#include "core/io/image_write.h"

namespace fluxwalk::app {

bool isLightFile(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension == ".exr";
}

void checkPictureFile(const std::filesystem::path& file, const LookArguments& look) {
    const render::DrawSettings& draw = look.draw;
    const bool isPlain = draw.shown == render::Shown::picture && !draw.elementEdges && !draw.clusterBoxes &&
                         !draw.glow && !draw.exposure && !look.inspection.links &&
                         !look.inspection.contributors;
    if (isLightFile(file) && !isPlain) {
        throw base::UsageError(
            "an .exr holds the light itself: --show, --overlay, --exposure and --glow are for .png");
    }
}

void writePixels(const std::filesystem::path& file, gl::PixelSize size, std::span<const std::uint8_t> rgb) {
    io::writePng(file, static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height), rgb);
}

void writeLight(const std::filesystem::path& file, gl::PixelSize size, std::span<const float> light) {
    io::writeExr(file, static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
                 light);
}

std::filesystem::path freePictureName(const std::filesystem::path& folder, std::string_view name,
                                      std::string_view extension) {
    std::string stem(name.empty() ? "fluxwalk" : name);
    std::replace_if(
        stem.begin(), stem.end(),
        [](unsigned char c) {
            return c <= ' ' || c == 0x7f ||
                   std::string_view("/\\:*?\"<>|.").find(static_cast<char>(c)) != std::string_view::npos;
        },
        '-');
    for (unsigned number = 1;; ++number) {
        std::filesystem::path file = folder / (stem + "-" + std::to_string(number) + std::string(extension));
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) {
            return file;
        }
    }
}

}  // namespace fluxwalk::app
