#pragma once

#include <functional>

#include "core/image/pixel_gather.h"
#include "core/image/still.h"
#include "core/scene/scene.h"

/// Stills: light is gathered at every pixel's exact point of the exact object (ALGORITHMS 1.14).
namespace fluxwalk::image {

/// Largest side and size of a still: 8k, and square pictures of as many pixels.
inline constexpr std::uint32_t kLargestSide = 16384;
inline constexpr std::uint64_t kMostPixels = 7680ull * 4320ull;

struct StillOptions {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    /// Samples of a pixel where its neighbours differ in object, normal or light; 1 for none.
    unsigned samples = 8;
    GatherRays rays;
    std::uint64_t seed = 1;
};

struct StillCallbacks {
    /// Fraction in [0, 1], after every strip of the picture.
    std::function<void(double)> progress;
    /// Asked between tiles, on any thread; true leaves the rest of the picture black.
    std::function<bool()> shouldStop;
    /// Called for each tile once its pixels are final, on any thread and on several at once. Of the still
    /// only these pixels may be read.
    std::function<void(const Still&, const StillTile&)> tileDone;
};

/// The picture that a camera takes of a solution. The same bits for any number of threads.
Still takeStill(const solve::Problem& problem, const scene::Camera& camera, const StillOptions& options,
                const StillCallbacks& callbacks = {});

}  // namespace fluxwalk::image
