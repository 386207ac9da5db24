#include "tests/architecture/layers.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace fluxwalk::architecture {
namespace {

std::string joinLines(const std::vector<std::string>& lines) {
    std::string joined;
    for (const std::string& line : lines) {
        joined += line + '\n';
    }
    return joined;
}

TEST(Layers, SourcesIncludeOnlyWhatTheTableAllows) {
    const std::filesystem::path root = FLUXWALK_SOURCE_DIR;
    const std::vector<std::string> files = listSources(root);
    ASSERT_GT(files.size(), 20u);
    std::vector<std::string> found;
    for (const std::string& file : files) {
        const std::vector<std::string> more = findViolations(file, readSource(root / file));
        found.insert(found.end(), more.begin(), more.end());
    }
    EXPECT_TRUE(found.empty()) << joinLines(found);
}

TEST(Layers, TableHasNoCycle) {
    // The table is written from the bottom up, so an edge that does not point to an earlier row is or makes a
    // cycle.
    std::set<std::string_view> below;
    for (const Layer& layer : layers()) {
        for (const std::string_view allowed : layer.allowed) {
            EXPECT_TRUE(below.contains(allowed)) << layer.folder << " -> " << allowed;
        }
        below.insert(layer.folder);
    }
}

TEST(Layers, CoreNeverIncludesTheViewer) {
    for (const Layer& layer : layers()) {
        for (const std::string_view allowed : layer.allowed) {
            if (layer.folder.starts_with("core/")) {
                EXPECT_TRUE(allowed.starts_with("core/")) << layer.folder << " -> " << allowed;
            }
        }
    }
    for (const Library& library : libraries()) {
        if (library.name == "OpenGL" || library.name == "GLFW" || library.name == "Dear ImGui") {
            EXPECT_EQ(library.allowed, std::vector<std::string_view>{"viewer"});
        }
    }
}

TEST(Layers, EveryFolderOfTheTableExistsAndBuildsItsSources) {
    const std::filesystem::path root = FLUXWALK_SOURCE_DIR;
    for (const Layer& layer : layers()) {
        EXPECT_TRUE(std::filesystem::is_directory(root / layer.folder)) << layer.folder;
        if (!layer.folder.starts_with("core/")) {
            continue;
        }
        const std::string build = readSource(root / layer.folder / "CMakeLists.txt");
        for (const std::string& file : listSources(root)) {
            const std::filesystem::path path = file;
            if (layerOf(file) == layer.folder && path.extension() == ".cpp") {
                EXPECT_NE(build.find(path.filename().string()), std::string::npos) << file << " is not built";
            }
        }
    }
}

TEST(Layers, ReaderFindsIncludesAndTheirLines) {
    const std::vector<Include> includes = readIncludes(
        "#pragma once\n\n#include <vector>\n  #  include \"core/base/vec.h\" // why\nint include;\n");
    ASSERT_EQ(includes.size(), 2u);
    EXPECT_EQ(includes[0].line, 3);
    EXPECT_EQ(includes[0].path, "vector");
    EXPECT_FALSE(includes[0].isQuoted);
    EXPECT_EQ(includes[1].line, 4);
    EXPECT_EQ(includes[1].path, "core/base/vec.h");
    EXPECT_TRUE(includes[1].isQuoted);
}

TEST(Layers, InnermostFolderNamesTheLayer) {
    EXPECT_EQ(layerOf("viewer/gl/loader.h"), "viewer/gl");
    EXPECT_EQ(layerOf("viewer/main.cpp"), "viewer");
    EXPECT_EQ(layerOf("core/base/vec.h"), "core/base");
    EXPECT_EQ(layerOf("core/baseless/vec.h"), "");
}

TEST(Layers, PlantedViolationsAreFound) {
    const std::map<std::string, std::string> planted = {
        {"#include \"core/solve/solver.h\"", "core/base/x.h:1: core/base may not include core/solve"},
        {"#include \"vec.h\"", "core/base/x.h:1: \"vec.h\" is not named from the root"},
        {"#include <GL/glcorearb.h>", "core/base/x.h:1: core/base may not include OpenGL"},
        {"#include <embree3/rtcore.h>", "core/base/x.h:1: core/base may not include Embree"},
        {"#include <tiny_gltf.h>", "core/base/x.h:1: core/base may not include tinygltf"},
    };
    for (const auto& [source, message] : planted) {
        EXPECT_EQ(findViolations("core/base/x.h", source), std::vector<std::string>{message});
    }
    EXPECT_TRUE(findViolations("core/rays/x.cpp", "#include <embree3/rtcore.h>\n#include <vector>").empty());
    EXPECT_TRUE(findViolations("viewer/gl/x.cpp", "#include <GL/glcorearb.h>").empty());
    EXPECT_EQ(findViolations("core/elsewhere/x.h", "").size(), 1u);
}

}  // namespace
}  // namespace fluxwalk::architecture
