#include "core/image/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace fluxwalk {
namespace {

using image::Color;
using image::Picture;

Color at(const Picture& picture, std::uint32_t x, std::uint32_t y) {
    const std::size_t i = 3 * (std::size_t{y} * picture.width + x);
    return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

double lightness(const Color& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

TEST(Chart, BlurKeepsTheMeanAndLeavesOutWhatIsUnknown) {
    constexpr std::uint32_t kWidth = 23;
    constexpr std::uint32_t kHeight = 17;
    std::vector<double> values(std::size_t{kWidth} * kHeight, 0.0);
    values[8 * kWidth + 11] = 1.0;
    const std::vector<double> spread = image::blurKnown(kWidth, kHeight, values, 1.5);
    // 1 / (2 pi s^2) in the middle, by e^-2 less at twice the deviation.
    EXPECT_NEAR(spread[8 * kWidth + 11], 1.0 / (2.0 * base::kPi * 2.25), 1e-3);
    EXPECT_NEAR(spread[8 * kWidth + 14] / spread[8 * kWidth + 11], std::exp(-2.0), 1e-9);
    EXPECT_NEAR(spread[5 * kWidth + 11], spread[8 * kWidth + 14], 1e-12);
    EXPECT_EQ(image::blurKnown(kWidth, kHeight, values, 0.0), values);
    std::fill(values.begin(), values.end(), 0.25);
    for (std::size_t i = 0; i < values.size(); i += 3) {
        values[i] = std::numeric_limits<double>::quiet_NaN();
    }
    const std::vector<double> same = image::blurKnown(kWidth, kHeight, values, 2.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % 3 == 0) {
            EXPECT_TRUE(std::isnan(same[i]));
        } else {
            EXPECT_NEAR(same[i], 0.25, 1e-12);
        }
    }
}

}  // namespace

TEST(Chart, colorsOfValuesBecomeLighter) {
    for (int i = 0; i < 20; ++i) {
        EXPECT_LT(lightness(image::colorOfValue(i / 20.0)), lightness(image::colorOfValue((i + 1) / 20.0)));
    }
    EXPECT_EQ(image::colorOfValue(-1.0), image::colorOfValue(0.0));
    EXPECT_EQ(image::colorOfDifference(0.0), (Color{255, 255, 255}));
    EXPECT_GT(image::colorOfDifference(0.7)[0], image::colorOfDifference(0.7)[2]) << "more is red";
    EXPECT_LT(image::colorOfDifference(-0.7)[0], image::colorOfDifference(-0.7)[2]) << "less is blue";
}

TEST(Chart, planShowsValuesInTheirPlaces) {
    image::Grid grid;
    grid.columns = 2;
    grid.rows = 3;
    grid.sensors.resize(6);
    std::vector<image::Measurement> measured(6);
    for (std::size_t i = 0; i < 6; ++i) {
        measured[i].illuminance = 100.0 * static_cast<double>(i);
    }
    measured[4].place = image::SensorPlace::solid;
    const Picture plan = image::drawPlan(grid, measured);
    ASSERT_EQ(plan.pixels.size(), std::size_t{3} * plan.width * plan.height);
    const std::uint32_t cell = plan.height / 3;
    EXPECT_EQ(at(plan, cell / 2, cell / 2), image::colorOfValue(0.0));
    EXPECT_EQ(at(plan, 3 * cell / 2, cell / 2), image::colorOfValue(0.2)) << "500 lx are the top";
    EXPECT_EQ(at(plan, 3 * cell / 2, 5 * cell / 2), image::colorOfValue(1.0));
    EXPECT_EQ(at(plan, cell / 2, 5 * cell / 2), (Color{128, 128, 128})) << "inside a solid";
    EXPECT_GT(plan.width, 2 * cell) << "a legend";
}

TEST(Chart, differencesHaveARoundRange) {
    std::vector<double> differences(100, 0.013);
    differences[3] = -7.0;
    differences[4] = NAN;
    const double range = image::chooseDifferenceRange(differences);
    EXPECT_DOUBLE_EQ(range, 0.02);
    const Picture picture = image::drawDifference(10, 10, differences, range);
    EXPECT_EQ(at(picture, 0, 0), image::colorOfDifference(0.65));
    EXPECT_EQ(at(picture, 3, 0), image::colorOfDifference(-1.0));
    EXPECT_EQ(at(picture, 4, 0), (Color{128, 128, 128}));
    EXPECT_DOUBLE_EQ(image::roundUp(0.02), 0.02);
    EXPECT_DOUBLE_EQ(image::roundUp(0.021), 0.05);
    EXPECT_DOUBLE_EQ(image::roundUp(7.0), 10.0);
}

}  // namespace fluxwalk
