#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "viewer/session/still_job.h"

/// Stills without a solution, for tests of who asks for them and who gets them.
namespace fluxwalk::testing {

using image::Still;
using image::StillCallbacks;
using image::StillOptions;

/// Waits for something that must come; a test that waits for ever is killed by ctest.
template <class Condition>
void waitFor(const Condition& condition) {
    while (!condition()) {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

inline StillOptions sized(std::uint32_t width, std::uint32_t height) {
    StillOptions options;
    options.width = width;
    options.height = height;
    options.samples = 2;
    options.rays.weak = 8;
    return options;
}

inline Still emptyStill(const StillOptions& options) {
    const std::size_t pixels = std::size_t{options.width} * options.height;
    Still still;
    still.width = options.width;
    still.height = options.height;
    still.luminance.resize(3 * pixels);
    still.irradiance.resize(3 * pixels);
    still.albedo.resize(3 * pixels);
    still.normal.resize(3 * pixels);
    still.object.resize(pixels);
    return still;
}

/// A still whose pixels are their numbers, made by two threads, row of tiles by row of tiles.
inline Still countPixels(const scene::Camera& /*camera*/, const StillOptions& options,
                         const StillCallbacks& callbacks) {
    Still still = emptyStill(options);
    std::atomic<bool> isStopped = false;
    const auto fill = [&](std::uint32_t top, std::uint32_t first) {
        for (std::uint32_t left = first * image::kTile; left < still.width; left += 2 * image::kTile) {
            if (callbacks.shouldStop()) {
                isStopped = true;
                return;
            }
            const image::StillTile tile{left, top, std::min(image::kTile, still.width - left),
                                        std::min(image::kTile, still.height - top)};
            for (std::uint32_t y = top; y < top + tile.height; ++y) {
                for (std::uint32_t x = left; x < left + tile.width; ++x) {
                    const std::size_t pixel = std::size_t{y} * still.width + x;
                    for (std::size_t c = 0; c < 3; ++c) {
                        still.luminance[3 * pixel + c] = static_cast<float>(pixel);
                    }
                }
            }
            callbacks.tileDone(still, tile);
        }
    };
    for (std::uint32_t top = 0; top < still.height; top += image::kTile) {
        std::thread other([&] { fill(top, 1); });
        fill(top, 0);
        other.join();
        if (isStopped) {
            break;
        }
        still.rowsDone = std::min(still.height, top + image::kTile);
        callbacks.progress(static_cast<double>(still.rowsDone) / still.height);
    }
    return still;
}

/// The picture that parts make, and how many of its pixels they cover.
struct Collected {
    std::vector<float> luminance;
    std::size_t pixels = 0;

    Collected(std::uint32_t width, std::uint32_t height)
        : luminance(std::size_t{3} * width * height), width_(width) {}
    void add(const std::vector<session::StillPart>& parts) {
        for (const session::StillPart& part : parts) {
            ASSERT_EQ(part.luminance.size(), std::size_t{3} * part.place.width * part.place.height);
            pixels += std::size_t{part.place.width} * part.place.height;
            for (std::uint32_t y = 0; y < part.place.height; ++y) {
                const std::size_t to = 3 * (std::size_t{part.place.top + y} * width_ + part.place.left);
                std::copy_n(&part.luminance[std::size_t{3} * y * part.place.width], 3 * part.place.width,
                            &luminance[to]);
            }
        }
    }

  private:
    std::uint32_t width_;
};

}  // namespace fluxwalk::testing
