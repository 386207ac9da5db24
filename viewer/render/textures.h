#pragma once

#include <map>
#include <memory>

#include "core/scene/scene.h"
#include "viewer/gl/objects.h"

namespace fluxwalk::render {

/// Texture coordinates to those of the picture: the KHR_texture_transform of a reference as an affine map.
glm::mat3 texcoordTransform(const scene::TextureRef& texture);

/// Mean of a picture's colours in linear light; of large pictures, of an even selection of 64k pixels.
base::Rgb meanColor(const scene::Image& image);

/// A scene's pictures on the GPU, sent when first used: with mipmaps, and anisotropic filtering where there
/// is.
class Textures {
  public:
    Textures(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene);

    /// Whether grazing views of pictures are sharp (anisotropic filtering), as at first. On a processor that
    /// takes as long as all the rest.
    void setSharp(bool isSharp) { isSharp_ = isSharp; }
    /// Binds the referenced picture, or white where there is none, to a texture unit.
    void bind(unsigned unit, const scene::TextureRef& texture);
    base::Rgb mean(const scene::TextureRef& texture);

  private:
    struct Loaded {
        gl::Texture texture;
        base::Rgb mean{1.0f};
    };
    Loaded& load(std::int32_t image);

    const gl::Functions& gl_;
    std::shared_ptr<const scene::Scene> scene_;
    std::map<std::int32_t, Loaded> loaded_;
    bool isSharp_ = true;
    float mostAnisotropy_ = 1.0f;  ///< 1 where the context has none
};

}  // namespace fluxwalk::render
