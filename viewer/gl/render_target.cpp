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

}  // namespace

RenderTarget::RenderTarget(const Functions& gl, PixelSize size, int samples)
    : gl_(gl),
      size_(size),
      samples_(supportedSamples(gl, samples)),
      drawn_(gl),
      color_(gl),
      depth_(gl),
      resolved_(gl),
      resolvedColor_(gl) {
    const auto attach = [&](const Renderbuffer& buffer, GLenum attachment, GLenum format, int count) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.id());
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count > 1 ? count : 0, format, size.width,
                                          size.height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.id());
    };
    gl.BindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    attach(color_, GL_COLOR_ATTACHMENT0, GL_RGBA8, samples_);
    attach(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, samples_);
    FLUXWALK_CHECK_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER),
                      static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    gl.BindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
    attach(resolvedColor_, GL_COLOR_ATTACHMENT0, GL_RGBA8, 1);
    FLUXWALK_CHECK_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER),
                      static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

void RenderTarget::bind() const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
    gl_.Viewport(0, 0, size_.width, size_.height);
}

void RenderTarget::resolve() const {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.id());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    gl_.BlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
}

void RenderTarget::copyToWindow() const {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl_.BlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

std::vector<std::uint8_t> RenderTarget::readRgb() const {
    const std::size_t rowBytes = static_cast<std::size_t>(size_.width) * 3;
    const auto height = static_cast<std::size_t>(size_.height);
    std::vector<std::uint8_t> fromBottom(rowBytes * height);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RGB, GL_UNSIGNED_BYTE, fromBottom.data());
    std::vector<std::uint8_t> fromTop(fromBottom.size());
    for (std::size_t row = 0; row < height; ++row) {
        std::copy_n(fromBottom.begin() + static_cast<std::ptrdiff_t>((height - 1 - row) * rowBytes), rowBytes,
                    fromTop.begin() + static_cast<std::ptrdiff_t>(row * rowBytes));
    }
    return fromTop;
}

}  // namespace fluxwalk::gl
