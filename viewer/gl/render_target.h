#pragma once

#include <cstdint>
#include <vector>

#include "viewer/gl/objects.h"
#include "viewer/gl/pixel_size.h"

namespace fluxwalk::gl {

/// An off-screen picture with depth, 8 bits a channel, with several samples a pixel where asked for.
class RenderTarget {
  public:
    /// `samples` 1 for none; more than the context offers are brought down to what it has.
    RenderTarget(const Functions& gl, PixelSize size, int samples);

    PixelSize size() const { return size_; }
    int samples() const { return samples_; }

    /// Makes this the place that is drawn into, with the viewport on all of it.
    void bind() const;
    /// Averages the samples; what follows is drawn over the averaged picture until bind().
    void resolve() const;
    /// Copies the resolved picture into the window's framebuffer.
    void copyToWindow() const;
    /// The resolved picture: 3 bytes a pixel, rows from the top.
    std::vector<std::uint8_t> readRgb() const;

  private:
    const Functions& gl_;
    PixelSize size_;
    int samples_;
    Framebuffer drawn_;
    Renderbuffer color_;
    Renderbuffer depth_;
    Framebuffer resolved_;
    Renderbuffer resolvedColor_;
};

}  // namespace fluxwalk::gl
