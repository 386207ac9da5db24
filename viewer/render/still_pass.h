#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "viewer/gl/render_target.h"
#include "viewer/render/tone.h"

namespace fluxwalk::render {

/// A still on the GPU while it is made: finished tiles are sent once, the rest shows what lies under it.
class StillPass {
  public:
    /// `size` of the still in pixels; nothing of it is made yet.
    StillPass(const gl::Functions& gl, gl::PixelSize size);

    gl::PixelSize size() const { return picture_.size(); }

    /// Pixels of the still from its upper left corner.
    struct Place {
        std::uint32_t left = 0;
        std::uint32_t top = 0;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
    };
    /// Sends a part that is made: luminance in cd/m2, three a pixel, rows from the top.
    void put(const Place& place, std::span<const float> luminance);

    /// How it is developed: exposure per cd/m2.
    struct Look {
        double exposure = 1.0;
        ToneCurve curve = ToneCurve::filmic;

        bool operator==(const Look&) const = default;
    };
    /// Draws over all of `target`, which stays bound; pixel by pixel as developStill() makes it where the
    /// sizes are the same. `under` holds light of the same view in cd/m2.
    void draw(const gl::RenderTarget& target, const gl::RenderTarget& under, const Look& look);

  private:
    const gl::Program& programFor(ToneCurve curve);

    const gl::Functions& gl_;
    gl::RenderTarget picture_;
    gl::VertexArray noVertices_;
    std::array<std::optional<gl::Program>, 4> programs_;
};

}  // namespace fluxwalk::render
