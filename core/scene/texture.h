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

    /// Sample of colour (linear light) and alpha, bilinear within a level and linear between two; `level` 0
    /// is the full picture. White where the reference names none.
    base::Vec4 sample(const TextureRef& texture, const base::Vec2d& texcoord, float level = 0.0f) const;
    /// Bilinear sample of what a picture holds as it is, each channel in [0, 1]: for pictures of normals and
    /// heights, which are not colours.
    base::Vec4 sampleNumbers(const TextureRef& texture, const base::Vec2d& texcoord) const;
    /// Pyramid level at which one texel is as large as `footprint` in texture coordinates (before the
    /// transform).
    float levelFor(const TextureRef& texture, double footprint) const;

  private:
    struct Level {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        /// Linear light; empty in level 0, which keeps its bytes (a quarter of the memory).
        std::vector<base::Vec4> texels;
        std::vector<std::uint8_t> bytes;

        base::Vec4 at(std::uint32_t x, std::uint32_t y) const;
        /// Level 0: its bytes as numbers.
        base::Vec4 numbersAt(std::uint32_t x, std::uint32_t y) const;
    };
    static Level halve(const Level& fine);
    static base::Vec4 bilinear(const Level& level, const TextureRef& texture, const base::Vec2d& uv);

    std::vector<std::vector<Level>> images_;
};

/// How much of a surface is there at a coordinate of its reflectance texture: 1; in AlphaMode::mask 0 in a
/// hole; in AlphaMode::blend the alpha.
float coverageAt(const Material& material, const TextureSet& textures, const base::Vec2d& texcoord);

/// Reflectance (at most kMaxReflectance) and emission in lm/m2 as it leaves the front, both weighed by what
/// is there (coverageAt): a hole neither reflects nor emits.
struct RegionMaterial {
    Rgb reflectance{0.0f};
    Rgb emission{0.0f};
};
/// Means over a region by true area.
RegionMaterial regionMaterial(const Scene& scene, const TextureSet& textures, const Object& object,
                              std::uint32_t patch, const surface::Region& region);

/// Reflectance and emission at one point of an object.
RegionMaterial pointMaterial(const Scene& scene, const TextureSet& textures, const Object& object,
                             std::uint32_t patch, const base::Vec2d& uv);

}  // namespace fluxwalk::scene
