#include "tests/architecture/layers.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace fluxwalk::architecture {

namespace {

using Names = std::vector<std::string_view>;

// From the bottom up; every layer names what it needs, not all that lies below it.
const std::vector<Layer> kLayers = {
    {"core/base", {}},
    {"core/surface", {"core/base"}},
    {"core/scene", {"core/base", "core/surface"}},
    {"core/rays", {"core/base", "core/surface", "core/scene"}},
    {"core/io", {"core/base", "core/surface", "core/scene"}},
    {"core/reference", {"core/base", "core/surface", "core/scene", "core/rays"}},
    {"core/hierarchy", {"core/base", "core/surface", "core/scene", "core/rays"}},
    {"core/transport", {"core/base", "core/surface", "core/scene", "core/rays", "core/hierarchy"}},
    {"core/display", {"core/base", "core/surface", "core/scene"}},
    {"core/solve",
     {"core/base", "core/surface", "core/scene", "core/rays", "core/hierarchy", "core/transport",
      "core/display"}},
    {"core/image",
     {"core/base", "core/surface", "core/scene", "core/rays", "core/hierarchy", "core/transport",
      "core/display", "core/solve"}},
    {"core/cli",
     {"core/base", "core/surface", "core/scene", "core/rays", "core/io", "core/reference", "core/hierarchy",
      "core/transport", "core/display", "core/solve", "core/image"}},
    {"viewer/gl", {"core/base"}},
    {"viewer/render", {"viewer/gl", "core/base", "core/scene"}},
    {"viewer/session", {"core/base", "core/scene", "core/rays", "core/solve", "core/image"}},
    {"viewer/ui",
     {"viewer/gl", "viewer/render", "viewer/session", "core/base", "core/scene", "core/rays", "core/solve",
      "core/image"}},
    {"viewer/app",
     {"viewer/gl", "viewer/render", "viewer/session", "viewer/ui", "core/base", "core/surface", "core/scene",
      "core/rays", "core/io", "core/solve", "core/image", "core/cli"}},
    {"viewer", {"viewer/app", "core/cli"}},
};

const std::vector<Library> kLibraries = {
    {"Embree", {"embree3/", "embree4/"}, {"core/rays"}},
    {"OpenSubdiv", {"opensubdiv/"}, {"core/surface"}},
    {"tinygltf", {"tiny_gltf.h"}, {"core/io"}},
    {"HDF5", {"hdf5", "H5"}, {"core/io"}},
    {"OpenEXR", {"OpenEXR/", "Imath/"}, {"core/io"}},
    {"stb", {"stb/", "stb_"}, {"core/io"}},
    {"TBB", {"tbb/", "oneapi/tbb"}, {"core/base"}},
    {"threads", {"thread", "future", "condition_variable"}, {"core/base", "viewer"}},
    {"nlohmann-json", {"nlohmann/"}, {"core/io", "core/cli"}},
    {"CLI11", {"CLI/"}, {"core/cli", "viewer"}},
    {"OpenGL", {"GL/", "GLES", "EGL/", "KHR/"}, {"viewer"}},
    {"GLFW", {"GLFW/"}, {"viewer"}},
    {"Dear ImGui", {"imgui", "backends/imgui", "misc/"}, {"viewer"}},
};

bool isBelow(std::string_view folder, std::string_view ancestor) {
    return folder == ancestor || (folder.starts_with(ancestor) && folder.size() > ancestor.size() &&
                                  folder[ancestor.size()] == '/');
}

bool contains(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string_view trimLeft(std::string_view text) {
    const std::size_t start = text.find_first_not_of(" \t");
    return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

void checkQuoted(const Include& include, std::string_view layer, const std::string& at,
                 std::vector<std::string>& found) {
    const std::string_view target = layerOf(include.path);
    if (target.empty()) {
        found.push_back(at + "\"" + include.path + "\" is not named from the root");
        return;
    }
    if (target == layer) {
        return;
    }
    const auto entry =
        std::find_if(kLayers.begin(), kLayers.end(), [&](const Layer& l) { return l.folder == layer; });
    if (!contains(entry->allowed, target)) {
        found.push_back(at + std::string(layer) + " may not include " + std::string(target));
    }
}

void checkAngled(const Include& include, std::string_view layer, const std::string& at,
                 std::vector<std::string>& found) {
    for (const Library& library : kLibraries) {
        const bool matches =
            std::any_of(library.includePrefixes.begin(), library.includePrefixes.end(),
                        [&](std::string_view prefix) { return include.path.starts_with(prefix); });
        const bool allowed = std::any_of(library.allowed.begin(), library.allowed.end(),
                                         [&](std::string_view folder) { return isBelow(layer, folder); });
        if (matches && !allowed) {
            found.push_back(at + std::string(layer) + " may not include " + std::string(library.name));
        }
    }
}

}  // namespace

std::span<const Layer> layers() {
    return kLayers;
}

std::span<const Library> libraries() {
    return kLibraries;
}

std::vector<Include> readIncludes(std::string_view source) {
    std::vector<Include> includes;
    int line = 0;
    while (!source.empty()) {
        const std::size_t end = std::min(source.find('\n'), source.size());
        std::string_view text = trimLeft(source.substr(0, end));
        source.remove_prefix(std::min(end + 1, source.size()));
        ++line;
        if (!text.starts_with('#')) {
            continue;
        }
        text = trimLeft(text.substr(1));
        if (!text.starts_with("include")) {
            continue;
        }
        text = trimLeft(text.substr(7));
        if (text.empty() || (text[0] != '"' && text[0] != '<')) {
            continue;
        }
        const bool isQuoted = text[0] == '"';
        const std::size_t close = text.find(isQuoted ? '"' : '>', 1);
        if (close != std::string_view::npos) {
            includes.push_back({line, std::string(text.substr(1, close - 1)), isQuoted});
        }
    }
    return includes;
}

std::string_view layerOf(std::string_view file) {
    std::string_view innermost;
    for (const Layer& layer : kLayers) {
        if (file != layer.folder && isBelow(file, layer.folder) && layer.folder.size() > innermost.size()) {
            innermost = layer.folder;
        }
    }
    return innermost;
}

std::vector<std::string> findViolations(std::string_view file, std::string_view source) {
    std::vector<std::string> found;
    const std::string_view layer = layerOf(file);
    if (layer.empty()) {
        return {std::string(file) + ": lies in no layer of tests/architecture/layers.cpp"};
    }
    for (const Include& include : readIncludes(source)) {
        const std::string at = std::string(file) + ":" + std::to_string(include.line) + ": ";
        if (include.isQuoted) {
            checkQuoted(include, layer, at, found);
        } else {
            checkAngled(include, layer, at, found);
        }
    }
    return found;
}

std::vector<std::string> listSources(const std::filesystem::path& root) {
    std::vector<std::string> files;
    for (const char* top : {"core", "viewer"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
            const std::filesystem::path extension = entry.path().extension();
            if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp")) {
                files.push_back(entry.path().lexically_relative(root).generic_string());
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string readSource(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace fluxwalk::architecture
