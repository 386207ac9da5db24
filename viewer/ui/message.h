#pragma once

#include <string>

namespace fluxwalk::ui {

/// Something the window tells: what was done, or what is wrong and where.
struct Message {
    std::string text;
    bool isError = false;
    double until = 0.0;  ///< seconds of the window's clock at which it goes
};

/// Draws it at the upper edge, in the middle; `scale` is 1 at 96 dpi.
void drawMessage(const Message& message, float scale);

/// Draws in the middle of the window, right of `left` (pixels), what it is still waiting for.
void drawWaiting(const std::string& text, float left);

}  // namespace fluxwalk::ui
