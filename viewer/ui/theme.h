#pragma once

#include <imgui.h>

/// Colours and measures of the panel: dark neutral greys, so that the picture is judged beside no colour, and
/// one warm accent.
namespace fluxwalk::ui {

inline const ImVec4 kAccent{0.96f, 0.72f, 0.36f, 1.0f};
inline const ImVec4 kTextDim{0.62f, 0.62f, 0.63f, 1.0f};
inline const ImVec4 kWarning{0.95f, 0.45f, 0.36f, 1.0f};
/// Second line of plots.
inline const ImVec4 kCool{0.55f, 0.72f, 0.86f, 1.0f};

/// Height of the panel's text in pixels at 96 dpi.
inline constexpr float kFontSize = 15.0f;

/// Gives the present ImGui context this look; `scale` is 1 at 96 dpi.
void applyTheme(float scale);

}  // namespace fluxwalk::ui
