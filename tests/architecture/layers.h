#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The house's rules about includes, and a reader that finds what breaks them.
namespace fluxwalk::architecture {

/// A folder and the folders that its files may include besides their own. Adding an edge here is a decision
/// about the design.
struct Layer {
    std::string_view folder;
    std::vector<std::string_view> allowed;
};
std::span<const Layer> layers();

/// A library that only some folders may include, by the start of its includes.
struct Library {
    std::string_view name;
    std::vector<std::string_view> includePrefixes;
    std::vector<std::string_view> allowed;  ///< folders; "viewer" stands for everything below it
};
std::span<const Library> libraries();

/// An include directive as written, "core/base/vec.h" or <vector>.
struct Include {
    int line = 0;
    std::string path;
    bool isQuoted = false;
};
std::vector<Include> readIncludes(std::string_view source);

/// Folder of the table that holds a file named from the root; the innermost one, empty where none does.
std::string_view layerOf(std::string_view file);

/// What is wrong with the includes of one file, a line each: "core/base/vec.h:3: ...".
std::vector<std::string> findViolations(std::string_view file, std::string_view source);

/// All .h and .cpp files below core/ and viewer/, named from the root with forward slashes, in order.
std::vector<std::string> listSources(const std::filesystem::path& root);
std::string readSource(const std::filesystem::path& file);

}  // namespace fluxwalk::architecture
