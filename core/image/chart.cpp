#include "core/image/chart.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "core/base/check.h"

namespace fluxwalk::image {

namespace {

/// Letters of the legend: 5 columns of 7 rows, the top row in the lowest bit.
struct Letter {
    char character;
    std::array<std::uint8_t, 5> columns;
};
constexpr std::array<Letter, 17> kLetters{{
    {'0', {0x3e, 0x51, 0x49, 0x45, 0x3e}},
    {'1', {0x00, 0x42, 0x7f, 0x40, 0x00}},
    {'2', {0x42, 0x61, 0x51, 0x49, 0x46}},
    {'3', {0x21, 0x41, 0x45, 0x4b, 0x31}},
    {'4', {0x18, 0x14, 0x12, 0x7f, 0x10}},
    {'5', {0x27, 0x45, 0x45, 0x45, 0x39}},
    {'6', {0x3c, 0x4a, 0x49, 0x49, 0x30}},
    {'7', {0x01, 0x71, 0x09, 0x05, 0x03}},
    {'8', {0x36, 0x49, 0x49, 0x49, 0x36}},
    {'9', {0x06, 0x49, 0x49, 0x29, 0x1e}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}},
    {'-', {0x08, 0x08, 0x08, 0x08, 0x08}},
    {'+', {0x08, 0x08, 0x3e, 0x08, 0x08}},
    {'%', {0x23, 0x13, 0x08, 0x64, 0x62}},
    {'l', {0x00, 0x00, 0x3f, 0x40, 0x40}},
    {'x', {0x44, 0x28, 0x10, 0x28, 0x44}},
    {'e', {0x38, 0x54, 0x54, 0x54, 0x18}},
}};
constexpr std::uint32_t kLetterWidth = 6;
constexpr std::uint32_t kLetterHeight = 7;
/// Legend: a bar on the right.
constexpr std::uint32_t kMargin = 12;
constexpr std::uint32_t kBarWidth = 16;
constexpr std::uint32_t kTextWidth = 9 * kLetterWidth;
constexpr std::uint32_t kLegendWidth = 3 * kMargin + kBarWidth + kTextWidth;
constexpr std::uint32_t kLeastHeight = 120;
constexpr unsigned kSteps = 5;
constexpr Color kPaper{250, 250, 250};
constexpr Color kInk{20, 20, 20};
constexpr Color kNothing{128, 128, 128};
/// Plans are drawn about this large.
constexpr std::uint32_t kPlanSide = 800;

void set(Picture& picture, std::uint32_t x, std::uint32_t y, const Color& color) {
    if (x < picture.width && y < picture.height) {
        std::copy(color.begin(), color.end(),
                  picture.pixels.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
    }
}

void drawText(Picture& picture, std::uint32_t x, std::uint32_t y, std::string_view text) {
    for (const char c : text) {
        for (const Letter& letter : kLetters) {
            for (std::uint32_t i = 0; letter.character == c && i < 5; ++i) {
                for (std::uint32_t j = 0; j < kLetterHeight; ++j) {
                    if ((std::uint32_t{letter.columns[i]} >> j & 1u) != 0) {
                        set(picture, x + i, y + j, kInk);
                    }
                }
            }
        }
        x += kLetterWidth;
    }
}

// Paper with room for a drawing in the upper left and a legend beside it. `labelAt` and `colorAt` take the
// place on the bar, 0 below and 1 above.
Picture makePaper(std::uint32_t width, std::uint32_t height,
                  const std::function<std::string(double)>& labelAt,
                  const std::function<Color(double)>& colorAt) {
    Picture picture{width + kLegendWidth, std::max(height, kLeastHeight), {}};
    picture.pixels.resize(std::size_t{3} * picture.width * picture.height);
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            set(picture, x, y, kPaper);
        }
    }
    const std::uint32_t bar = std::min(picture.height, 400u) - 2 * kMargin;
    for (std::uint32_t y = 0; y < bar; ++y) {
        for (std::uint32_t x = 0; x < kBarWidth; ++x) {
            set(picture, width + kMargin + x, kMargin + y, colorAt(1.0 - (y + 0.5) / bar));
        }
    }
    for (unsigned i = 0; i <= kSteps; ++i) {
        const double place = static_cast<double>(i) / kSteps;
        const auto y = kMargin + static_cast<std::uint32_t>(std::lround((1.0 - place) * (bar - 1)));
        for (std::uint32_t x = 0; x < 4; ++x) {
            set(picture, width + kMargin + kBarWidth + x, y, kInk);
        }
        drawText(picture, width + 2 * kMargin + kBarWidth, y - kLetterHeight / 2, labelAt(place));
    }
    return picture;
}

Color mixColors(const Color& a, const Color& b, double part) {
    Color result{};
    for (std::size_t c = 0; c < 3; ++c) {
        result[c] = static_cast<std::uint8_t>(std::lround((1.0 - part) * a[c] + part * b[c]));
    }
    return result;
}

}  // namespace

Color colorOfValue(double place) {
    constexpr std::array<Color, 9> kViridis{{{68, 1, 84},
                                             {71, 44, 122},
                                             {59, 81, 139},
                                             {44, 113, 142},
                                             {33, 144, 141},
                                             {39, 173, 129},
                                             {92, 200, 99},
                                             {170, 220, 50},
                                             {253, 231, 37}}};
    const double at = std::clamp(place, 0.0, 1.0) * (kViridis.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
    return mixColors(kViridis[first], kViridis[first + 1], at - static_cast<double>(first));
}

Color colorOfDifference(double place) {
    constexpr Color kLess{33, 80, 172};
    constexpr Color kSame{255, 255, 255};
    constexpr Color kMore{178, 24, 43};
    const double at = std::clamp(place, -1.0, 1.0);
    return mixColors(kSame, at < 0.0 ? kLess : kMore, std::abs(at));
}

double roundUp(double value) {
    FLUXWALK_CHECK_LT(0.0, value);
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit * power >= value * (1.0 - 1e-9)) {
            return digit * power;
        }
    }
    return 10.0 * power;
}

Picture drawPlan(const Grid& grid, std::span<const Measurement> measured) {
    FLUXWALK_CHECK_EQ(measured.size(), std::size_t{grid.columns} * grid.rows);
    const double brightest = summarize(measured).maximum;
    // A fifth of it is a round number, too.
    const double top = brightest > 0.0 ? kSteps * roundUp(brightest / kSteps) : 1.0;
    const std::uint32_t scale = std::max(1u, kPlanSide / std::max(grid.columns, grid.rows));
    Picture picture = makePaper(
        grid.columns * scale, grid.rows * scale,
        [top](double place) { return fmt::format("{:g} lx", top * place); }, colorOfValue);
    for (std::uint32_t y = 0; y < grid.rows * scale; ++y) {
        for (std::uint32_t x = 0; x < grid.columns * scale; ++x) {
            const Measurement& m = measured[std::size_t{y / scale} * grid.columns + x / scale];
            set(picture, x, y, m.place == SensorPlace::solid ? kNothing : colorOfValue(m.illuminance / top));
        }
    }
    return picture;
}

std::vector<double> blurKnown(std::uint32_t width, std::uint32_t height, std::span<const double> values,
                              double deviation) {
    std::vector<double> blurred(values.begin(), values.end());
    if (!(deviation > 0.0)) {
        return blurred;
    }
    const auto reach = static_cast<std::int64_t>(std::ceil(3.0 * deviation));
    std::vector<double> fall;
    for (std::int64_t d = -reach; d <= reach; ++d) {
        fall.push_back(std::exp(-0.5 * static_cast<double>(d * d) / (deviation * deviation)));
    }
    // Sums of values and of weights, along rows and then along columns.
    std::vector<double> sums(values.size());
    std::vector<double> weights(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        weights[i] = std::isfinite(values[i]) ? 1.0 : 0.0;
        sums[i] = weights[i] > 0.0 ? values[i] : 0.0;
    }
    const auto along = [&](std::vector<double>& data, std::int64_t count, std::int64_t step) {
        const std::vector<double> before = data;
        for (std::int64_t i = 0; i < static_cast<std::int64_t>(data.size()); ++i) {
            const std::int64_t at = i / step % count;
            double sum = 0.0;
            for (std::int64_t d = std::max(-reach, -at); d <= std::min(reach, count - 1 - at); ++d) {
                sum += fall[static_cast<std::size_t>(d + reach)] *
                       before[static_cast<std::size_t>(i + d * step)];
            }
            data[static_cast<std::size_t>(i)] = sum;
        }
    };
    for (std::vector<double>* data : {&sums, &weights}) {
        along(*data, width, 1);
        along(*data, height, width);
    }
    for (std::size_t i = 0; i < blurred.size(); ++i) {
        if (std::isfinite(blurred[i])) {
            blurred[i] = sums[i] / weights[i];
        }
    }
    return blurred;
}

double chooseDifferenceRange(std::span<const double> differences) {
    std::vector<double> sizes;
    for (const double d : differences) {
        if (std::isfinite(d)) {
            sizes.push_back(std::abs(d));
        }
    }
    if (sizes.empty()) {
        return 1.0;
    }
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 98 / 100);
    std::nth_element(sizes.begin(), at, sizes.end());
    return *at > 0.0 ? roundUp(*at) : 0.01;
}

Picture drawDifference(std::uint32_t width, std::uint32_t height, std::span<const double> differences,
                       double range) {
    FLUXWALK_CHECK_EQ(differences.size(), std::size_t{width} * height);
    Picture picture = makePaper(
        width, height,
        [range](double place) { return fmt::format("{:+g} %", 100.0 * range * (2.0 * place - 1.0)); },
        [](double place) { return colorOfDifference(2.0 * place - 1.0); });
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const double d = differences[std::size_t{y} * width + x];
            set(picture, x, y, std::isfinite(d) ? colorOfDifference(d / range) : kNothing);
        }
    }
    return picture;
}

}  // namespace fluxwalk::image
