#pragma once

#include <string_view>

/// The GLSL files of shaders/, copied into the program by the build. They carry no #version line: `tone.glsl`
/// and `false_color.glsl` go before the fragment shaders that use them.
namespace fluxwalk::gl::shaders {

extern const std::string_view kLitVertex;
extern const std::string_view kLitFragment;
extern const std::string_view kBackgroundVertex;
extern const std::string_view kBackgroundFragment;
extern const std::string_view kTone;
extern const std::string_view kFalseColor;
extern const std::string_view kFaceVertex;
extern const std::string_view kFaceFragment;
extern const std::string_view kLineVertex;
extern const std::string_view kLineFragment;
extern const std::string_view kGlowVertex;
extern const std::string_view kGlowFragment;
extern const std::string_view kPanelVertex;
extern const std::string_view kPanelFragment;
extern const std::string_view kStillFragment;

/// First line of every shader.
inline constexpr std::string_view kVersion = "#version 330 core\n";

}  // namespace fluxwalk::gl::shaders
