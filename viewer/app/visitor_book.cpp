#include "viewer/app/visitor_book.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/io/visitor_files.h"

namespace fluxwalk::app {
namespace {

constexpr int kMostPaths = 9999;

bool isThere(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
}

void makeFolderOf(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error) {
        throw base::FileError(file.parent_path().string(), "", "cannot be made: " + error.message());
    }
}

std::string inDigits(std::uint64_t hash) {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    return digits.data();
}

}  // namespace

const std::filesystem::path& VisitorBook::folder() const {
    if (!folder_) {
        throw base::UsageError("nothing can be kept: neither XDG_STATE_HOME nor HOME names a folder");
    }
    return *folder_;
}

std::filesystem::path VisitorBook::bookmarksFile() const {
    FLUXWALK_CHECK(scene_.has_value());
    return folder() / "bookmarks" / (inDigits(*scene_) + ".json");
}

void VisitorBook::requireReadable(const std::filesystem::path& file, bool isReadable) const {
    if (!isReadable) {
        throw base::FileError(file.string(), "", "could not be read, and is left untouched");
    }
}

void VisitorBook::openScene(std::uint64_t hash) {
    scene_ = hash;
    bookmarks_.clear();
    knowsBookmarks_ = false;
    if (folder_ && isThere(bookmarksFile())) {
        bookmarks_ = io::readBookmarks(bookmarksFile());
    }
    knowsBookmarks_ = true;
}

void VisitorBook::writeBookmarks(std::vector<scene::Camera> bookmarks) {
    const std::filesystem::path file = bookmarksFile();
    requireReadable(file, knowsBookmarks_);
    makeFolderOf(file);
    io::writeBookmarks(file, bookmarks);
    bookmarks_ = std::move(bookmarks);
}

std::string VisitorBook::keep(const scene::Camera& camera) {
    std::vector<scene::Camera> bookmarks = bookmarks_;
    scene::Camera bookmark = camera;
    const auto isTaken = [&](const scene::Camera& other) { return other.name == bookmark.name; };
    int number = 0;
    do {
        bookmark.name = "View " + std::to_string(++number);
    } while (std::any_of(bookmarks.begin(), bookmarks.end(), isTaken));
    bookmarks.push_back(bookmark);
    writeBookmarks(std::move(bookmarks));
    return bookmark.name;
}

void VisitorBook::forget(std::size_t bookmark) {
    std::vector<scene::Camera> bookmarks = bookmarks_;
    bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(bookmark));
    writeBookmarks(std::move(bookmarks));
}

void VisitorBook::readRecentFiles() {
    knowsRecentFiles_ = false;
    if (folder_ && isThere(*folder_ / "recent.json")) {
        recentFiles_ = io::readRecentFiles(*folder_ / "recent.json");
    }
    knowsRecentFiles_ = true;
}

void VisitorBook::remember(const std::filesystem::path& file) {
    const std::filesystem::path list = folder() / "recent.json";
    requireReadable(list, knowsRecentFiles_);
    const std::string name = std::filesystem::absolute(file).lexically_normal().string();
    std::vector<std::string> files{name};
    std::copy_if(recentFiles_.begin(), recentFiles_.end(), std::back_inserter(files),
                 [&](const std::string& other) { return other != name; });
    files.resize(std::min(files.size(), kMostRecent));
    makeFolderOf(list);
    io::writeRecentFiles(list, files);
    recentFiles_ = std::move(files);
}

std::filesystem::path VisitorBook::savePath(const scene::CameraPath& path) const {
    for (int i = 1; i <= kMostPaths; ++i) {
        const std::filesystem::path file = folder() / "paths" / ("path-" + std::to_string(i) + ".json");
        if (!isThere(file)) {
            makeFolderOf(file);
            io::writeCameraPath(file, path);
            return file;
        }
    }
    throw base::FileError((folder() / "paths").string(), "",
                          "holds " + std::to_string(kMostPaths) + " paths");
}

}  // namespace fluxwalk::app
