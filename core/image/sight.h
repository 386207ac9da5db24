#pragma once

#include <optional>

#include "core/image/pixel_gather.h"
#include "core/scene/texture.h"

/// What a camera sees along a line, before light is gathered there.
namespace fluxwalk::image {

/// A point that is seen.
struct Seen {
    std::uint32_t object = 0;
    NodeId leaf = NodeId::none;  ///< none where light does not reach that side
    PixelPoint point;
    Rgb reflectance{0.0f};
    Rgb emission{0.0f};  ///< lm/m2 towards the eye
    bool hasRelief = false;
    bool hasTexture = false;
};

/// Directions through a picture's pixels.
class Lens {
  public:
    Lens(const scene::Camera& camera, std::uint32_t width, std::uint32_t height);

    /// Through a place in pixels from the upper left corner.
    Vec3d directionAt(const base::Vec2d& pixel) const;
    const Vec3d& eye() const { return eye_; }

  private:
    Vec3d eye_{};
    Vec3d corner_{};  ///< direction through the upper left corner
    Vec3d right_{};   ///< for each pixel
    Vec3d down_{};
};

/// What a line from a point meets first; nothing where it leaves the scene.
std::optional<Seen> lookAlong(const solve::Problem& problem, const Vec3d& eye, const Vec3d& direction);

/// Luminance in cd/m2 of the sky in a direction; black below the horizon.
Rgb skyLuminance(const solve::Problem& problem, const Vec3d& direction);

}  // namespace fluxwalk::image
