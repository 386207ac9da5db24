#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/camera_path.h"

/// What visitors of scenes keep, as JSON: places, ways, and the files they opened. Readers throw
/// base::FileError with a JSON pointer or a line; writers replace the whole file or leave the one before.
namespace fluxwalk::io {

/// Key frames: seconds that rise, and a camera (position in metres, forward, up, fov in vertical degrees).
scene::CameraPath readCameraPath(const std::filesystem::path& file);
void writeCameraPath(const std::filesystem::path& file, const scene::CameraPath& path);

/// Cameras with names.
std::vector<scene::Camera> readBookmarks(const std::filesystem::path& file);
void writeBookmarks(const std::filesystem::path& file, const std::vector<scene::Camera>& bookmarks);

/// Names of files, the last one first.
std::vector<std::string> readRecentFiles(const std::filesystem::path& file);
void writeRecentFiles(const std::filesystem::path& file, const std::vector<std::string>& files);

}  // namespace fluxwalk::io
