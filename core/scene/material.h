#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/vec.h"

/// What a surface does with light, and the pictures that vary it.
namespace fluxwalk::scene {

using base::Rgb;
using base::Vec2;

/// Decoded picture, 8 bits a channel, rows from the top. `rgba` holds width * height * 4 bytes as in the file
/// (sRGB where it is colour).
struct Image {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
};

enum class Wrap : std::uint8_t { repeat, mirror, clamp };

/// Reference to an image with KHR_texture_transform: uv' = offset + R(rotation) * (scale * uv).
struct TextureRef {
    std::int32_t image = -1;  ///< index into Scene::images, -1 for none
    std::uint8_t texcoordSet = 0;
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    Vec2 offset{0.0f};
    Vec2 scale{1.0f};
    float rotation = 0.0f;  ///< radians

    bool isSet() const { return image >= 0; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Largest reflectance that the solver accepts. The readers clamp factors without a texture to it,
/// scene/texture each sample of a texture; both with a warning from the reader.
inline constexpr float kMaxReflectance = 0.98f;

/// Diffuse material. Reflectance = factor x sRGB texture, emission = factor x sRGB texture.
struct Material {
    std::string name;
    Rgb reflectance{0.5f};
    TextureRef reflectanceTexture;
    /// Exitance M in lm/m2 (pi times the luminance in nits), leaving the front only unless doubleSided.
    Rgb emission{0.0f};
    TextureRef emissionTexture;
    bool doubleSided = false;
    AlphaMode alphaMode = AlphaMode::opaque;
    float alpha = 1.0f;        ///< factor of the reflectance texture's alpha
    float alphaCutoff = 0.5f;  ///< AlphaMode::mask: alpha below it is a hole
    TextureRef normalTexture;
    float normalScale = 1.0f;
    TextureRef bumpTexture;    ///< height map (`fluxwalk_bump`), used by final gathering
    float bumpHeight = 0.01f;  ///< metres from its black to its white

    bool isEmissive() const { return emission.r > 0.0f || emission.g > 0.0f || emission.b > 0.0f; }
};

}  // namespace fluxwalk::scene
