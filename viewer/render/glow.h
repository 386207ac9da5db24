#pragma once

#include <memory>
#include <vector>

#include "viewer/gl/render_target.h"
#include "viewer/render/lit_pass.h"

namespace fluxwalk::render {

/// The veil that lenses and eyes spread around what shines: a small part of all light, blurred over widths
/// from about a hundredth of the picture's height to a fourth of it, whatever its size in pixels. No light is
/// added: the glow takes the place of the part that it came from. Costs one drawing at a quarter of the size
/// and as much as a third of its pixels again.
class Glow {
  public:
    explicit Glow(const gl::Functions& gl);

    /// Binds a small target for the light of a picture of this size, as Output::light.
    gl::PixelSize begin(gl::PixelSize picture);
    /// Blurs what was drawn since.
    GlowLayer finish();

  private:
    void filter(const gl::RenderTarget& from, const gl::RenderTarget& to, float reach, float part) const;

    const gl::Functions& gl_;
    gl::Program program_;
    gl::VertexArray noVertices_;
    std::unique_ptr<gl::RenderTarget> light_;
    /// Each half as wide as the one before.
    std::vector<std::unique_ptr<gl::RenderTarget>> levels_;
};

}  // namespace fluxwalk::render
