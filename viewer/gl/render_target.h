#pragma once

#include <cstdint>
#include <vector>

#include "viewer/gl/objects.h"
#include "viewer/gl/pixel_size.h"

namespace fluxwalk::gl {

/// Of one colour of a pixel: bytes for the screen, floats for light.
enum class PixelFormat : std::uint8_t { byte, half, full };

/// An off-screen picture, with several samples a pixel where asked for.
class RenderTarget {
  public:
    /// `samples` 1 for none; more than the context offers are brought down to what it has.
    RenderTarget(const Functions& gl, PixelSize size, int samples, PixelFormat format = PixelFormat::byte,
                 bool hasDepth = true);

    PixelSize size() const { return size_; }
    int samples() const { return samples_; }

    /// Makes this the place that is drawn into, with the viewport on all of it.
    void bind() const;
    /// Averages the samples; what follows is drawn over the averaged picture until bind().
    void resolve() const;
    /// Copies the resolved picture into the window's framebuffer.
    void copyToWindow() const;
    /// The resolved picture, linearly filtered and clamped at its edges; without mipmaps.
    const Texture& texture() const { return resolvedColor_; }
    /// The resolved picture: 3 bytes a pixel, rows from the top.
    std::vector<std::uint8_t> readRgb() const;
    /// The same as it is in floats, 3 a pixel.
    std::vector<float> readLight() const;

  private:
    /// What is drawn into before samples are averaged.
    struct Samples {
        explicit Samples(const Functions& gl) : framebuffer(gl), color(gl) {}
        Framebuffer framebuffer;
        Renderbuffer color;
    };
    GLuint drawn() const { return samples_ > 1 ? many_.framebuffer.id() : resolved_.id(); }
    template <class T>
    std::vector<T> read(GLenum type) const;

    const Functions& gl_;
    PixelSize size_;
    int samples_;
    Samples many_;
    Renderbuffer depth_;
    Framebuffer resolved_;
    Texture resolvedColor_;
};

}  // namespace fluxwalk::gl
