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

/// Draws the table over the middle of the window, as small as the window needs; `scale` is 1 at 96 dpi.
void drawKeyTable(float scale);

/// What the line of keys tells about.
struct KeyHints {
    bool isCaptured = false;  ///< the mouse looks around
    bool isWalking = false;
    bool isPanelOpen = true;
};

/// Draws the keys that are needed most along the bottom of the window, as many as fit right of `left`, in
/// pixels.
void drawKeys(const KeyHints& hints, float left, float scale);

}  // namespace fluxwalk::ui
