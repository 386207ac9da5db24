#include "core/io/visitor_files.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/photometry.h"
#include "core/io/file.h"
#include "core/io/json_checks.h"

namespace fluxwalk::io {
namespace {

using base::Vec3d;
using nlohmann::json;

constexpr std::uint64_t kMaxBytes = 1u << 26;
constexpr double kDegrees = 180.0 / base::kPi;
constexpr double kLongestPath = 86400.0;

std::string lineOf(const std::vector<std::uint8_t>& bytes, std::size_t byte) {
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(byte, bytes.size()));
    return "line " + std::to_string(1 + std::count(bytes.begin(), end, '\n'));
}

json parse(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file, kMaxBytes);
    try {
        return json::parse(bytes.begin(), bytes.end());
    } catch (const json::parse_error& error) {
        const std::size_t last = error.byte > 0 ? error.byte - 1 : 0;
        throw base::FileError(file.string(), lineOf(bytes, last), "is not JSON");
    } catch (const json::exception&) {
        throw base::FileError(file.string(), "", "holds a number that is out of range");
    }
}

/// A document of ours: what it holds and its version are said at its beginning.
class Document {
  public:
    Document(const std::filesystem::path& file, const char* kind)
        : root_(parse(file)), checks_(file.string(), root_) {
        if (!root_.is_object() || root_.value("fluxwalk", json()) != kind) {
            checks_.fail("", std::string("is no file of fluxwalk's ") + kind);
        }
        if (root_.value("version", json()) != 1) {
            checks_.fail("/version", "is not 1, the only one that is known");
        }
    }
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    const json& section(const char* key) const {
        const auto found = root_.find(key);
        if (found == root_.end() || !found->is_array()) {
            checks_.fail(std::string("/") + key, "is not an array");
        }
        return *found;
    }
    const JsonChecks& checks() const { return checks_; }

    double number(const json& owner, const char* key, const std::string& place) const {
        const auto found = owner.find(key);
        if (found == owner.end() || !found->is_number() || !std::isfinite(found->get<double>())) {
            checks_.fail(place + "/" + key, "is not a number");
        }
        return found->get<double>();
    }

    scene::Camera camera(const json& owner, const std::string& place) const {
        if (!owner.is_object()) {
            checks_.fail(place, "is not an object");
        }
        scene::Camera camera;
        camera.position = vector(owner, "position", place);
        camera.forward = vector(owner, "forward", place);
        camera.up = vector(owner, "up", place);
        camera.verticalFov = number(owner, "fov", place) / kDegrees;
        if (const auto fault = scene::findFault(camera)) {
            checks_.fail(place, "the camera " + *fault);
        }
        camera.forward = glm::normalize(camera.forward);
        return camera;
    }

  private:
    Vec3d vector(const json& owner, const char* key, const std::string& place) const {
        checks_.require(owner, key, place);
        checks_.checkNumbers(owner, key, 3, place);
        const json& v = owner.at(key);
        return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
    }

    json root_;
    JsonChecks checks_;
};

json toJson(const Vec3d& v) {
    return {v.x, v.y, v.z};
}

json toJson(const scene::Camera& camera) {
    return {{"position", toJson(camera.position)},
            {"forward", toJson(camera.forward)},
            {"up", toJson(camera.up)},
            {"fov", camera.verticalFov * kDegrees}};
}

void write(const std::filesystem::path& file, const char* kind, const char* section, json items) {
    const json root{{"fluxwalk", kind}, {"version", 1}, {section, std::move(items)}};
    // Names of files and cameras need not be UTF-8.
    writeFile(file, root.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace

scene::CameraPath readCameraPath(const std::filesystem::path& file) {
    const Document document(file, "camera path");
    scene::CameraPath path;
    for (const json& item : document.section("keys")) {
        const std::string place = "/keys/" + std::to_string(path.size());
        scene::CameraKey key;
        key.camera = document.camera(item, place);
        key.seconds = document.number(item, "seconds", place);
        if (!(key.seconds >= 0.0 && key.seconds <= kLongestPath) ||
            (!path.empty() && !(key.seconds > path.back().seconds))) {
            document.checks().fail(place + "/seconds", "the times of keys must rise, within a day");
        }
        path.push_back(std::move(key));
    }
    if (path.empty()) {
        document.checks().fail("/keys", "holds no key");
    }
    return path;
}

void writeCameraPath(const std::filesystem::path& file, const scene::CameraPath& path) {
    json keys = json::array();
    for (const scene::CameraKey& key : path) {
        json item = toJson(key.camera);
        item["seconds"] = key.seconds;
        keys.push_back(std::move(item));
    }
    write(file, "camera path", "keys", std::move(keys));
}

std::vector<scene::Camera> readBookmarks(const std::filesystem::path& file) {
    const Document document(file, "bookmarks");
    std::vector<scene::Camera> bookmarks;
    for (const json& item : document.section("cameras")) {
        const std::string place = "/cameras/" + std::to_string(bookmarks.size());
        scene::Camera camera = document.camera(item, place);
        const auto name = item.find("name");
        if (name == item.end() || !name->is_string()) {
            document.checks().fail(place + "/name", "is not a text");
        }
        camera.name = base::toOneLine(name->get<std::string>());
        bookmarks.push_back(std::move(camera));
    }
    return bookmarks;
}

void writeBookmarks(const std::filesystem::path& file, const std::vector<scene::Camera>& bookmarks) {
    json cameras = json::array();
    for (const scene::Camera& bookmark : bookmarks) {
        json item = toJson(bookmark);
        item["name"] = bookmark.name;
        cameras.push_back(std::move(item));
    }
    write(file, "bookmarks", "cameras", std::move(cameras));
}

std::vector<std::string> readRecentFiles(const std::filesystem::path& file) {
    const Document document(file, "recent files");
    std::vector<std::string> files;
    for (const json& item : document.section("files")) {
        if (!item.is_string()) {
            document.checks().fail("/files/" + std::to_string(files.size()), "is not a text");
        }
        files.push_back(item.get<std::string>());
    }
    return files;
}

void writeRecentFiles(const std::filesystem::path& file, const std::vector<std::string>& files) {
    write(file, "recent files", "files", json(files));
}

}  // namespace fluxwalk::io
