#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/scene/gallery.h"

namespace fluxwalk::scene::gallery {

namespace {

/// Colours of the pictures are sRGB in 0..1, as painters mix them.
using Color = base::Vec3d;

/// Called with the middle of a pixel: x to the right and y downwards, both in 0..1.
template <class Paint>
Image draw(std::string name, std::uint32_t width, std::uint32_t height, const Paint& paint) {
    Image image{std::move(name), width, height, {}};
    image.rgba.reserve(std::size_t{4} * width * height);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const Color c = paint(base::Vec2d((x + 0.5) / width, (y + 0.5) / height));
            for (int channel = 0; channel < 3; ++channel) {
                image.rgba.push_back(
                    static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c[channel], 0.0, 1.0))));
            }
            image.rgba.push_back(255);
        }
    }
    return image;
}

double randomOf(std::uint64_t a, std::uint64_t b) {
    return base::toUnit(base::combine(base::combine(0x9a11e47, a), b));
}

Color mixed(const Color& a, const Color& b, double part) {
    return a + std::clamp(part, 0.0, 1.0) * (b - a);
}

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

constexpr Color hex(unsigned rgb) {
    return {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0};
}

// Fields that float over each other.
Color paintFields(const base::Vec2d& at) {
    Color c = mixed(hex(0x7c2f1d), hex(0x5a1f22), at.y);
    const auto field = [&](double top, double bottom, const Color& color) {
        const double edge = 0.035;
        const double inside = smooth(0.07, 0.07 + edge, at.x) * (1.0 - smooth(0.93 - edge, 0.93, at.x)) *
                              smooth(top, top + edge, at.y) * (1.0 - smooth(bottom - edge, bottom, at.y));
        c = mixed(c, color, 0.92 * inside);
    };
    field(0.07, 0.44, hex(0xe0792b));
    field(0.47, 0.60, hex(0xf0c06a));
    field(0.63, 0.94, hex(0xa82b2b));
    return c;
}

// Rings about three centres; where they overlap the palette moves on.
Color paintRings(const base::Vec2d& at) {
    constexpr std::array<Color, 6> kPalette{hex(0xf2e9d8), hex(0xd9412c), hex(0x21497b),
                                            hex(0xf0b23a), hex(0x2b8a7e), hex(0x1d1f2b)};
    const base::Vec2d p(at.x, at.y * 4.0 / 3.0);
    constexpr std::array<base::Vec2d, 3> kCenters{{{0.34, 0.42}, {0.70, 0.66}, {0.36, 0.98}}};
    constexpr std::array<double, 3> kRadii{0.30, 0.26, 0.22};
    std::size_t index = 0;
    for (std::size_t i = 0; i < kCenters.size(); ++i) {
        const double distance = glm::length(p - kCenters[i]) / kRadii[i];
        if (distance < 1.0) {
            index += 1 + i + static_cast<std::size_t>(distance * 4.0);
        }
    }
    return kPalette[index % kPalette.size()];
}

// A landscape of hills, one behind the other into the haze.
Color paintHills(const base::Vec2d& at) {
    Color c = mixed(hex(0x9fc3d6), hex(0xf5dcb8), at.y * 1.7);
    if (glm::length(base::Vec2d(1.33 * (at.x - 0.68), at.y - 0.28)) < 0.075) {
        c = hex(0xfff3d0);
    }
    for (unsigned i = 0; i < 5; ++i) {
        const double phase = 6.28 * randomOf(7, i);
        const double line = 0.42 + 0.11 * i + (0.05 + 0.01 * i) * std::sin((5.5 - 0.6 * i) * at.x + phase) +
                            0.018 * std::sin((17.0 - i) * at.x + 2.0 * phase);
        if (at.y > line) {
            c = mixed(hex(0xb9c8c4), hex(0x16382f), 0.1 + 0.21 * i);
        }
    }
    return c;
}

// Bars and blocks on white.
Color paintBlocks(const base::Vec2d& at) {
    constexpr std::array<double, 3> kColumns{0.26, 0.72, 0.90};
    constexpr std::array<double, 3> kRows{0.18, 0.57, 0.83};
    const auto cellOf = [](const std::array<double, 3>& cuts, double v) {
        return std::count_if(cuts.begin(), cuts.end(), [v](double cut) { return v > cut; });
    };
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::abs(at.x - kColumns[i]) < 0.015 || std::abs(at.y - kRows[i]) < 0.011) {
            return hex(0x17171a);
        }
    }
    const auto cell = 4 * cellOf(kRows, at.y) + cellOf(kColumns, at.x);
    switch (cell) {
        case 5:
            return hex(0xc9281f);
        case 0:
        case 14:
            return hex(0x1f3f93);
        case 11:
        case 12:
            return hex(0xf1c21b);
        default:
            return hex(0xefebe0);
    }
}

}  // namespace

Image drawFloor() {
    // Sticks of 1 : 4, each row a step on from the last; the pattern repeats after 8 widths.
    constexpr unsigned kSticks = 16;
    return draw("herringbone", 512, 512, [](const base::Vec2d& at) {
        const double x = at.x * kSticks;
        const double y = at.y * kSticks;
        const auto i = static_cast<int>(x);
        const auto j = static_cast<int>(y);
        // Cell (i, j) belongs to a stick along x where (i - j) mod 8 < 4, else to one along y.
        const int m = (((i - j) % 8) + 8) % 8;
        const bool isAlongX = m < 4;
        const int first = isAlongX ? i - m : j - (7 - m);
        const auto wrap = [](int v) {
            return static_cast<std::uint64_t>((v + 2 * static_cast<int>(kSticks)) %
                                              static_cast<int>(kSticks));
        };
        const std::uint64_t name = isAlongX ? wrap(first) * 64 + wrap(j) : 4096 + wrap(i) * 64 + wrap(first);
        const double along = isAlongX ? x - first : y - first;
        const double across = isAlongX ? y - j : x - i;
        const double tone = randomOf(name, 1);
        Color c = mixed(hex(0x8f6a45), hex(0xb98f62), tone);
        // Grain: streaks along the stick.
        const auto streak = static_cast<std::uint64_t>(across * 9.0);
        c *= 0.95 + 0.07 * randomOf(name * 16 + streak, 2) + 0.015 * std::sin(7.0 * along + 6.0 * tone);
        const double edge = std::min({across, 1.0 - across, along, 4.0 - along});
        return c * (0.62 + 0.38 * smooth(0.0, 0.045, edge));
    });
}

Image drawPainting(unsigned number) {
    switch (number) {
        case 0:
            return draw("hills", 256, 192, paintHills);
        case 1:
            return draw("rings", 192, 256, paintRings);
        case 2:
            return draw("fields", 256, 192, paintFields);
        default:
            return draw("blocks", 192, 256, paintBlocks);
    }
}

}  // namespace fluxwalk::scene::gallery
