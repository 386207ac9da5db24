#include "viewer/render/glow.h"

#include <algorithm>
#include <string>

#include "viewer/gl/shaders.h"

namespace fluxwalk::render {
namespace {

/// Of the light that eyes scatter: a tenth in age, less in youth (Vos 1984); pictures bear half of it.
constexpr float kPart = 0.05f;
/// Of the light, what the widest level leaves to finer ones, and each of these again; the finest takes the
/// rest. So the glow of small pictures, which have fewer levels, is as wide as that of large ones.
constexpr float kToFiner = 0.75f;
constexpr int kLeastHeight = 48;
constexpr int kMostHeight = 270;
/// Pixels of the widest level's height: what it blurs reaches over a good part of the picture.
constexpr int kWidestHeight = 6;
/// Small lamps must not flicker when they pass from pixel to pixel.
constexpr int kSamples = 4;

std::string withVersion(std::string_view source) {
    return std::string(gl::shaders::kVersion) + std::string(source);
}

}  // namespace

Glow::Glow(const gl::Functions& gl)
    : gl_(gl),
      program_(gl, "glow", withVersion(gl::shaders::kGlowVertex), withVersion(gl::shaders::kGlowFragment)),
      noVertices_(gl) {}

gl::PixelSize Glow::begin(gl::PixelSize picture) {
    const int height = std::clamp(picture.height / 4, kLeastHeight, kMostHeight);
    const gl::PixelSize size{std::max(1, height * picture.width / std::max(picture.height, 1)), height};
    if (light_ == nullptr || !(light_->size() == size)) {
        // Floats, as lamps may be brighter than halves can say.
        light_ = std::make_unique<gl::RenderTarget>(gl_, size, kSamples, gl::PixelFormat::full);
        levels_.clear();
        for (gl::PixelSize level = size; level.height >= kWidestHeight;) {
            levels_.push_back(
                std::make_unique<gl::RenderTarget>(gl_, level, 1, gl::PixelFormat::full, false));
            level = {std::max(1, level.width / 2), level.height / 2};
        }
    }
    light_->bind();
    return size;
}

void Glow::filter(const gl::RenderTarget& from, const gl::RenderTarget& to, float reach, float part) const {
    to.bind();
    gl_.Uniform2f(program_.uniform("reach"), reach / static_cast<GLfloat>(from.size().width),
                  reach / static_cast<GLfloat>(from.size().height));
    gl_.Uniform1f(program_.uniform("part"), part);
    gl_.BindTexture(GL_TEXTURE_2D, from.texture().id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

GlowLayer Glow::finish() {
    light_->resolve();
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    program_.use();
    gl_.Uniform1i(program_.uniform("source"), 0);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindVertexArray(noVertices_.id());
    filter(*light_, *levels_[0], 0.5f, 1.0f);
    for (std::size_t i = 1; i < levels_.size(); ++i) {
        filter(*levels_[i - 1], *levels_[i], 1.0f, 1.0f);
    }
    gl_.Enable(GL_BLEND);
    gl_.BlendEquation(GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    float left = kToFiner;
    for (std::size_t i = levels_.size() - 1; i > 0; --i) {
        const float wider = 1.0f - left;
        left = i > 1 ? left * kToFiner : 0.0f;
        filter(*levels_[i], *levels_[i - 1], 0.5f, wider / (1.0f - left));
    }
    gl_.Disable(GL_BLEND);
    gl_.BindVertexArray(0);
    return {levels_[0]->texture().id(), kPart};
}

}  // namespace fluxwalk::render
