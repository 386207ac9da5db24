#pragma once

#include "viewer/gl/objects.h"

struct ImDrawData;

namespace fluxwalk::ui {

/// How ImGui's lists call a texture.
void* textureId(GLuint texture);

/// Draws ImGui's lists through our own GL functions, so that panels appear in windows, under EGL and under
/// OSMesa alike. Made after the fonts were added to the present ImGui context.
class ImguiRenderer {
  public:
    explicit ImguiRenderer(const gl::Functions& gl);

    /// Takes the glyphs of the present ImGui context's fonts; to be called when these changed.
    void takeGlyphs();
    /// Draws over what the bound framebuffer holds.
    void draw(const ImDrawData& data) const;

  private:
    const gl::Functions& gl_;
    gl::Program program_;
    gl::Texture glyphs_;
    gl::VertexArray array_;
    gl::Buffer vertices_;
    gl::Buffer indices_;
};

}  // namespace fluxwalk::ui
