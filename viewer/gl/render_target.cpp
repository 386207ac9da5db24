#include "viewer/gl/render_target.h"

#include <algorithm>

#include "core/base/check.h"

namespace fluxwalk::gl {
namespace {

int supportedSamples(const Functions& gl, int wanted) {
    GLint most = 1;
    gl.GetIntegerv(GL_MAX_SAMPLES, &most);
    return std::clamp(wanted, 1, std::max(1, static_cast<int>(most)));
}

GLenum internalFormat(PixelFormat format) {
    switch (format) {
        case PixelFormat::half:
            return GL_RGBA16F;
        case PixelFormat::full:
            return GL_RGBA32F;
        case PixelFormat::byte:
            break;
    }
    return GL_RGBA8;
}

void requireComplete(const Functions& gl) {
    FLUXWALK_CHECK_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER),
                      static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

}  // namespace

RenderTarget::RenderTarget(const Functions& gl, PixelSize size, int samples, PixelFormat format,
                           bool hasDepth)
    : gl_(gl),
      size_(size),
      samples_(supportedSamples(gl, samples)),
      many_(gl),
      depth_(gl),
      resolved_(gl),
      resolvedColor_(gl) {
    const auto attach = [&](const Renderbuffer& buffer, GLenum attachment, GLenum internal) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.id());
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples_ > 1 ? samples_ : 0, internal, size.width,
                                          size.height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.id());
    };
    const GLenum color = internalFormat(format);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, resolvedColor_.id());
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(color), size.width, size.height, 0, GL_RGBA,
                  format == PixelFormat::byte ? GL_UNSIGNED_BYTE : GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.BindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, resolvedColor_.id(), 0);
    requireComplete(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, drawn());
    if (samples_ > 1) {
        attach(many_.color, GL_COLOR_ATTACHMENT0, color);
    }
    if (hasDepth) {
        attach(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24);
    }
    requireComplete(gl);
}

void RenderTarget::bind() const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn());
    gl_.Viewport(0, 0, size_.width, size_.height);
}

void RenderTarget::resolve() const {
    if (samples_ > 1) {
        gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn());
        gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
        gl_.BlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height,
                            GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
}

void RenderTarget::copyToWindow() const {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl_.BlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

template <class T>
std::vector<T> RenderTarget::read(GLenum type) const {
    const std::size_t rowLength = static_cast<std::size_t>(size_.width) * 3;
    const auto height = static_cast<std::size_t>(size_.height);
    std::vector<T> fromBottom(rowLength * height);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RGB, type, fromBottom.data());
    std::vector<T> fromTop(fromBottom.size());
    for (std::size_t row = 0; row < height; ++row) {
        std::copy_n(fromBottom.begin() + static_cast<std::ptrdiff_t>((height - 1 - row) * rowLength),
                    rowLength, fromTop.begin() + static_cast<std::ptrdiff_t>(row * rowLength));
    }
    return fromTop;
}

std::vector<std::uint8_t> RenderTarget::readRgb() const {
    return read<std::uint8_t>(GL_UNSIGNED_BYTE);
}

std::vector<float> RenderTarget::readLight() const {
    return read<float>(GL_FLOAT);
}

}  // namespace fluxwalk::gl
