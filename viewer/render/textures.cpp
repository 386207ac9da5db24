#include "viewer/render/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "viewer/render/tone.h"

namespace fluxwalk::render {
namespace {

constexpr std::int32_t kWhite = -1;
/// Where pictures are sent, away from the units that are drawn with.
constexpr GLenum kSendingUnit = GL_TEXTURE8;
/// Names of EXT_texture_filter_anisotropic, core since 4.6: floors seen along stay sharp.
constexpr GLenum kTextureMaxAnisotropy = 0x84FE;
constexpr GLenum kMaxTextureMaxAnisotropy = 0x84FF;
constexpr float kAnisotropy = 8.0f;

GLint wrapMode(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::mirror:
            return GL_MIRRORED_REPEAT;
        case scene::Wrap::clamp:
            return GL_CLAMP_TO_EDGE;
        case scene::Wrap::repeat:
            break;
    }
    return GL_REPEAT;
}

/// Every `step`-th pixel of a picture that is larger than the GPU can hold.
scene::Image everyNth(const scene::Image& image, std::uint32_t step) {
    scene::Image result;
    result.width = image.width / step;
    result.height = image.height / step;
    result.rgba.reserve(std::size_t{4} * result.width * result.height);
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            const std::size_t from = 4 * (std::size_t{y} * step * image.width + std::size_t{x} * step);
            result.rgba.insert(result.rgba.end(), &image.rgba[from], &image.rgba[from] + 4);
        }
    }
    return result;
}

}  // namespace

glm::mat3 texcoordTransform(const scene::TextureRef& texture) {
    const float c = std::cos(texture.rotation);
    const float s = std::sin(texture.rotation);
    // Columns, as in the extension's text: offset * R(rotation) * scale.
    return {glm::vec3(c * texture.scale.x, -s * texture.scale.x, 0.0f),
            glm::vec3(s * texture.scale.y, c * texture.scale.y, 0.0f), glm::vec3(texture.offset, 1.0f)};
}

base::Rgb meanColor(const scene::Image& image) {
    const std::size_t count = std::size_t{image.width} * image.height;
    if (count == 0) {
        return base::Rgb(1.0f);
    }
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        linear[i] = static_cast<double>(decodeSrgb(static_cast<std::uint8_t>(i)));
    }
    const std::size_t selected = std::min<std::size_t>(count, 65536);
    base::Vec3d sum(0.0);
    for (std::size_t i = 0; i < selected; ++i) {
        const std::size_t pixel = 4 * (i * count / selected);
        sum += base::Vec3d(linear[image.rgba[pixel]], linear[image.rgba[pixel + 1]],
                           linear[image.rgba[pixel + 2]]);
    }
    return base::Rgb(sum / static_cast<double>(selected));
}

Textures::Textures(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene)
    : gl_(gl), scene_(std::move(scene)) {
    GLint count = 0;
    gl_.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const auto* name =
            reinterpret_cast<const char*>(gl_.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
        if (name != nullptr && std::string_view(name).ends_with("_texture_filter_anisotropic")) {
            gl_.GetFloatv(kMaxTextureMaxAnisotropy, &mostAnisotropy_);
        }
    }
}

void Textures::bind(unsigned unit, const scene::TextureRef& texture) {
    const Loaded& loaded = load(texture.image);
    gl_.ActiveTexture(GL_TEXTURE0 + unit);
    gl_.BindTexture(GL_TEXTURE_2D, loaded.texture.id());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapMode(texture.wrapU));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapMode(texture.wrapV));
    if (mostAnisotropy_ > 1.0f) {
        gl_.TexParameterf(GL_TEXTURE_2D, kTextureMaxAnisotropy,
                          isSharp_ ? std::min(mostAnisotropy_, kAnisotropy) : 1.0f);
    }
}

base::Rgb Textures::mean(const scene::TextureRef& texture) {
    return load(texture.image).mean;
}

Textures::Loaded& Textures::load(std::int32_t index) {
    const bool isKnown = index >= 0 && static_cast<std::size_t>(index) < scene_->images.size();
    const std::int32_t key = isKnown ? index : kWhite;
    if (const auto found = loaded_.find(key); found != loaded_.end()) {
        return found->second;
    }
    scene::Image white;
    white.width = white.height = 1;
    white.rgba.assign(4, 255);
    const scene::Image* image = isKnown ? &scene_->images[static_cast<std::size_t>(index)] : &white;
    if (image->width == 0 || image->height == 0) {
        image = &white;
    }
    Loaded& loaded = loaded_.try_emplace(key, Loaded{gl::Texture(gl_), meanColor(*image)}).first->second;

    GLint largest = 1024;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const auto limit = static_cast<std::uint32_t>(largest);
    scene::Image reduced;
    if (const std::uint32_t side = std::max(image->width, image->height); side > limit) {
        reduced = everyNth(*image, (side + limit - 1) / limit);
        image = &reduced;
    }
    gl_.ActiveTexture(kSendingUnit);
    gl_.BindTexture(GL_TEXTURE_2D, loaded.texture.id());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, static_cast<GLsizei>(image->width),
                   static_cast<GLsizei>(image->height), 0, GL_RGBA, GL_UNSIGNED_BYTE, image->rgba.data());
    gl_.GenerateMipmap(GL_TEXTURE_2D);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return loaded;
}

}  // namespace fluxwalk::render
