#include "viewer/render/light_meter.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::render {
namespace {

constexpr int kHeight = 54;
constexpr int kMostWidth = 216;
/// Fall of the weight: the middles of the edges have 1/e of the middle's.
constexpr double kFall = 1.0;

}  // namespace

gl::PixelSize meterSize(double aspect) {
    return {std::clamp(static_cast<int>(std::lround(kHeight * aspect)), 1, kMostWidth), kHeight};
}

double meterExposure(std::span<const float> pixels, gl::PixelSize size) {
    LuminanceHistogram reflecting;
    LuminanceHistogram emitting;
    const float* pixel = pixels.data();
    for (int row = 0; row < size.height; ++row) {
        const double y = 2.0 * (row + 0.5) / size.height - 1.0;
        for (int column = 0; column < size.width; ++column) {
            const double x = 2.0 * (column + 0.5) / size.width - 1.0;
            const double weight = std::exp(-kFall * (x * x + y * y));
            reflecting.add(static_cast<double>(pixel[0]), weight);
            emitting.add(static_cast<double>(pixel[1]), weight);
            pixel += 3;
        }
    }
    return automaticExposure(reflecting, emitting);
}

}  // namespace fluxwalk::render
