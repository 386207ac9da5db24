#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/scene/scene.h"
#include "core/surface/region.h"

/// Colours of textures in linear light, filtered: the mean over an element is what its radiosity needs.
namespace fluxwalk::scene {

/// All images of a scene as linear-light pyramids (box filter, each level half the size).
class TextureSet {
  public:
    explicit TextureSet(const Scene& scene);

    /// Bilinear sample of colour (linear light) and alpha; `level` 0 is the full picture. White where the
    /// reference names none.
    base::Vec4 sample(const TextureRef& texture, const base::Vec2d& texcoord, float level = 0.0f) const;
    /// Pyramid level at which one texel is as large as `footprint` in texture coordinates (before the
    /// transform).
    float levelFor(const TextureRef& texture, double footprint) const;

  private:
    struct Level {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<base::Vec4> texels;
    };
    std::vector<std::vector<Level>> images_;
};

/// Means over a region by true area: reflectance, and emission in lm/m2 as it leaves the front.
struct RegionMaterial {
    Rgb reflectance{0.0f};
    Rgb emission{0.0f};
};
RegionMaterial regionMaterial(const Scene& scene, const TextureSet& textures, const Object& object,
                              std::uint32_t patch, const surface::Region& region);

/// Reflectance and emission at one point of an object.
RegionMaterial pointMaterial(const Scene& scene, const TextureSet& textures, const Object& object,
                             std::uint32_t patch, const base::Vec2d& uv);

}  // namespace fluxwalk::scene
