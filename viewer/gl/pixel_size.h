#pragma once

namespace fluxwalk::gl {

/// Size of a picture in pixels.
struct PixelSize {
    int width = 0;
    int height = 0;
    bool operator==(const PixelSize&) const = default;
};

}  // namespace fluxwalk::gl
