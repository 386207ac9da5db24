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

}  // namespace fluxwalk::ui
