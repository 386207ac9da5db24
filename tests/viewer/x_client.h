#pragma once

#include <string>

/// What xdotool cannot do, through Xlib on $DISPLAY. Both look for the window that takes dropped files.
namespace fluxwalk::testing {

/// Drags a file onto the middle of the window and lets it go there. Returns whether the window took it.
bool dropFile(const std::string& file);

/// Asks the window to close, as the button in its frame does. Returns whether there was one.
bool closeWindow();

}  // namespace fluxwalk::testing
