#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "viewer/app/look_arguments.h"
#include "viewer/gl/pixel_size.h"

/// Pictures as files: *.exr holds light, all others are PNG.
namespace fluxwalk::app {

bool isLightFile(const std::filesystem::path& file);

/// Throws base::UsageError where the file cannot hold what the look asks for.
void checkPictureFile(const std::filesystem::path& file, const LookArguments& look);

/// Write rows from the top, three values a pixel. Throw base::FileError.
void writePixels(const std::filesystem::path& file, gl::PixelSize size, std::span<const std::uint8_t> rgb);
void writeLight(const std::filesystem::path& file, gl::PixelSize size, std::span<const float> light);

/// "NAME-1.png", or the next number that is free in the folder; letters that file names should not have
/// become dashes.
std::filesystem::path freePictureName(const std::filesystem::path& folder, std::string_view name,
                                      std::string_view extension);

}  // namespace fluxwalk::app
