#include "viewer/render/still_pass.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.h"
#include "viewer/gl/shaders.h"

namespace fluxwalk::render {
namespace {

/// Pixels of the still that one tap covers, each way: it is filtered between four.
constexpr double kTapWidth = 2.0;
constexpr int kMostTaps = 8;

}  // namespace

StillPass::StillPass(const gl::Functions& gl, gl::PixelSize size)
    : gl_(gl), picture_(gl, size, 1, gl::PixelFormat::full, false), noVertices_(gl) {
    picture_.bind();
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
}

void StillPass::put(const Place& place, std::span<const float> luminance) {
    FLUXWALK_CHECK_EQ(luminance.size(), std::size_t{3} * place.width * place.height);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, picture_.texture().id());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    // Alpha becomes 1.
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(place.left), static_cast<GLint>(place.top),
                      static_cast<GLsizei>(place.width), static_cast<GLsizei>(place.height), GL_RGB, GL_FLOAT,
                      luminance.data());
}

const gl::Program& StillPass::programFor(ToneCurve curve) {
    const auto number = static_cast<std::size_t>(curve);
    std::optional<gl::Program>& program = programs_[number];
    if (!program) {
        const std::string head = std::string(gl::shaders::kVersion) + "#define GLOW 0\n#define CURVE " +
                                 std::to_string(number) + "\n";
        program.emplace(gl_, "still",
                        std::string(gl::shaders::kVersion) + std::string(gl::shaders::kGlowVertex),
                        head + std::string(gl::shaders::kTone) + std::string(gl::shaders::kStillFragment));
    }
    return *program;
}

void StillPass::draw(const gl::RenderTarget& target, const gl::RenderTarget& under, const Look& look) {
    const gl::Program& program = programFor(look.curve);
    const gl::PixelSize size = picture_.size();
    // Pixels of the still for each that is drawn.
    const double acrossX = static_cast<double>(size.width) / target.size().width;
    const double acrossY = static_cast<double>(size.height) / target.size().height;
    const double across = std::max(acrossX, acrossY);
    const int taps = across <= 1.0 ? 1 : std::min(kMostTaps, static_cast<int>(std::ceil(across / kTapWidth)));
    target.bind();
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.Disable(GL_BLEND);
    program.use();
    gl_.Uniform1i(program.uniform("still"), 0);
    gl_.Uniform1i(program.uniform("under"), 1);
    gl_.Uniform1i(program.uniform("taps"), taps);
    gl_.Uniform2f(program.uniform("reach"), static_cast<GLfloat>(1.0 / (target.size().width * taps)),
                  static_cast<GLfloat>(1.0 / (target.size().height * taps)));
    gl_.Uniform1f(program.uniform("exposure"), static_cast<GLfloat>(look.exposure));
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, under.texture().id());
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, picture_.texture().id());
    gl_.BindVertexArray(noVertices_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.BindVertexArray(0);
    target.resolve();
}

}  // namespace fluxwalk::render
