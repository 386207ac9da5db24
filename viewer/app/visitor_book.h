#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/camera_path.h"

namespace fluxwalk::app {

/// What a visitor keeps from one run of the program to the next: bookmarks of each scene, paths, and files
/// opened lately. A file of these that cannot be read is left untouched. Every member that touches files
/// throws base::FileError, or base::UsageError where there is no folder to keep things in.
class VisitorBook {
  public:
    /// Files that are remembered.
    static constexpr std::size_t kMostRecent = 10;

    /// `folder` is made when something is kept; nothing where there is none.
    explicit VisitorBook(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

    /// Reads the bookmarks of a scene, known by its hash.
    void openScene(std::uint64_t hash);
    /// Whether openScene() was called.
    bool hasScene() const { return scene_.has_value(); }

    const std::vector<scene::Camera>& bookmarks() const { return bookmarks_; }
    /// Under the first free name "View N"; returns the name.
    std::string keep(const scene::Camera& camera);
    void forget(std::size_t bookmark);

    void readRecentFiles();
    const std::vector<std::string>& recentFiles() const { return recentFiles_; }
    /// Puts a file first.
    void remember(const std::filesystem::path& file);

    /// Writes a path under a name of its own; returns the file.
    std::filesystem::path savePath(const scene::CameraPath& path) const;

  private:
    const std::filesystem::path& folder() const;
    std::filesystem::path bookmarksFile() const;
    void requireReadable(const std::filesystem::path& file, bool isReadable) const;
    void writeBookmarks(std::vector<scene::Camera> bookmarks);

    std::optional<std::filesystem::path> folder_;
    std::optional<std::uint64_t> scene_;
    std::vector<scene::Camera> bookmarks_;
    std::vector<std::string> recentFiles_;
    /// Whether what the files hold is known, so that they may be replaced.
    bool knowsBookmarks_ = false;
    bool knowsRecentFiles_ = false;
};

}  // namespace fluxwalk::app
