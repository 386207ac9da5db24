#include "viewer/render/color_map.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "viewer/render/tone.h"

namespace fluxwalk::render {
namespace {

using base::Vec3d;

/// Ends of the map. Its first colour is lighter than the background of pictures, its last short of white.
constexpr double kDarkest = 0.24;
constexpr double kLightest = 0.96;
constexpr double kFirstHue = 305.0;
constexpr double kLastHue = 98.0;
constexpr double kChroma = 0.15;
/// Away from the limit of the screen's colours, where hues shift.
constexpr double kOfLargestChroma = 0.92;

/// Linear Rec. 709 of an OKLab colour.
Vec3d linearOfLab(double lightness, double a, double b) {
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
    const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
    const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Vec3d linearOfLch(double lightness, double chroma, double hue) {
    const double angle = hue * base::kPi / 180.0;
    return linearOfLab(lightness, chroma * std::cos(angle), chroma * std::sin(angle));
}

double largestChroma(double lightness, double hue) {
    double least = 0.0;
    double most = 0.4;
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (least + most);
        const Vec3d c = linearOfLch(lightness, middle, hue);
        const bool isShown = std::min({c.r, c.g, c.b}) >= 0.0 && std::max({c.r, c.g, c.b}) <= 1.0;
        (isShown ? least : most) = middle;
    }
    return least;
}

}  // namespace

Vec3d colorOfLch(double lightness, double chroma, double hue) {
    const Vec3d linear =
        linearOfLch(lightness, std::min(chroma, kOfLargestChroma * largestChroma(lightness, hue)), hue);
    Vec3d color;
    for (int i = 0; i < 3; ++i) {
        color[i] = static_cast<double>(encodeSrgb(static_cast<float>(linear[i])));
    }
    return color;
}

ColorMap::ColorMap() {
    for (std::size_t i = 0; i < kSize; ++i) {
        const double place = static_cast<double>(i) / (kSize - 1);
        const Vec3d color = colorOfLch(kDarkest + place * (kLightest - kDarkest), kChroma,
                                       kFirstHue + place * (kLastHue - kFirstHue));
        for (int c = 0; c < 3; ++c) {
            colors_[i][static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(std::lround(255.0 * color[c]));
        }
    }
}

const Color8& ColorMap::at(double place) const {
    return colors_[static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, 1.0) * (kSize - 1)))];
}

base::Rgb colorOfNumber(std::uint32_t number) {
    // Hues by the golden angle; three lightnesses keep those apart that come close after a while.
    constexpr double kGoldenAngle = 137.50776405;
    const double hue = std::fmod(20.0 + number * kGoldenAngle, 360.0);
    return base::Rgb(colorOfLch(0.62 + 0.1 * (number % 3), 0.12, hue));
}

}  // namespace fluxwalk::render
