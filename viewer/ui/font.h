#pragma once

#include <string_view>

namespace fluxwalk::ui {

/// The TrueType file of the panel's font, put into the program by the build; empty if there was none.
extern const std::string_view kFontFile;

}  // namespace fluxwalk::ui
