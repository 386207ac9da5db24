#pragma once

#include <span>
#include <string>
#include <string_view>

/// What keys and mouse do: one table for the window's help, --help and the README.
namespace fluxwalk::ui {

struct KeyLine {
    std::string_view keys;
    std::string_view meaning;
};

struct KeyGroup {
    std::string_view title;
    std::span<const KeyLine> lines;
};

std::span<const KeyGroup> keyGroups();

/// The table as plain text, a line for each key.
std::string describeKeys();

/// Draws the table over the middle of the window; `scale` is 1 at 96 dpi.
void drawKeyTable(float scale);

}  // namespace fluxwalk::ui
