#include "viewer/render/false_color.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/photometry.h"
#include "viewer/app/look_arguments.h"
#include "viewer/render/color_map.h"
#include "viewer/render/tone.h"
#include "viewer/ui/legend.h"

namespace fluxwalk::render {
namespace {

/// CIE 1976 lightness of a screen's colour, 0 to 100.
double lightnessOf(const Color8& color) {
    const double y = static_cast<double>(
        base::luminance(base::Rgb(decodeSrgb(color[0]), decodeSrgb(color[1]), decodeSrgb(color[2]))));
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

TEST(ColorMap, LightnessRisesEvenly) {
    const ColorMap map;
    const double first = lightnessOf(map.at(0.0));
    const double last = lightnessOf(map.at(1.0));
    EXPECT_LT(first, 15.0);
    EXPECT_GT(last, 93.0);
    for (int i = 1; i <= 16; ++i) {
        const double rise = lightnessOf(map.at(i / 16.0)) - lightnessOf(map.at((i - 1) / 16.0));
        EXPECT_NEAR(rise, (last - first) / 16.0, 0.25 * (last - first) / 16.0) << i;
    }
}

TEST(ColorMap, ColorsOfGreyAndPrimariesAreKnown) {
    const base::Vec3d white = colorOfLch(1.0, 0.0, 0.0);
    EXPECT_NEAR(white.r, 1.0, 1e-4);
    EXPECT_NEAR(white.b, 1.0, 1e-4);
    // Ottosson's table: sRGB red is OKLCh (0.628, 0.2577, 29.23 degrees); its chroma is cut to 92 %.
    const base::Vec3d red = colorOfLch(0.627955, 0.9 * 0.257683, 29.2339);
    EXPECT_GT(red.r, 0.95);
    EXPECT_LT(red.g, 0.3);
    EXPECT_LT(red.b, 0.3);
}

TEST(ValueRange, PlacesAreThoseOfTheScale) {
    EXPECT_DOUBLE_EQ(placeOf(30.0, {10.0, 50.0}, ValueScale::linear), 0.5);
    EXPECT_NEAR(placeOf(100.0, {10.0, 1000.0}, ValueScale::logarithmic), 0.5, 1e-12);
    EXPECT_EQ(placeOf(0.0, {10.0, 1000.0}, ValueScale::logarithmic), 0.0);
    EXPECT_EQ(placeOf(1e9, {10.0, 1000.0}, ValueScale::linear), 1.0);
}

TEST(ValueRange, RoundNumbersLieWithin) {
    EXPECT_EQ(roundNumbers({10.0, 500.0}, ValueScale::logarithmic),
              (std::vector<double>{10.0, 20.0, 50.0, 100.0, 200.0, 500.0}));
    EXPECT_EQ(roundNumbers({0.3, 3.0}, ValueScale::logarithmic), (std::vector<double>{0.5, 1.0, 2.0}));
    EXPECT_EQ(roundNumbers({0.0, 500.0}, ValueScale::linear),
              (std::vector<double>{0.0, 100.0, 200.0, 300.0, 400.0, 500.0}));
    EXPECT_EQ(roundStep({0.0, 1000.0}), 200.0);
}

TEST(ValueRange, IsChosenRoundAboutWhatThereIs) {
    LuminanceHistogram values;
    values.add(30.0, 10.0);
    values.add(350.0, 10.0);
    EXPECT_EQ(chooseRange(values, ValueScale::logarithmic), (ValueRange{20.0, 500.0}));
    EXPECT_EQ(chooseRange(values, ValueScale::linear), (ValueRange{0.0, 500.0}));
    values.add(1e-5, 10.0);
    EXPECT_NEAR(chooseRange(values, ValueScale::logarithmic).least, 0.05, 1e-9);
    // Nothing lit still has a range to show.
    EXPECT_EQ(chooseRange({}, ValueScale::linear).most, 1000.0);
}

TEST(ValueRange, IsReadAsTyped) {
    EXPECT_EQ(app::parseRange("10:500"), (ValueRange{10.0, 500.0}));
    for (const char* text : {"", "10", "10:", ":5", "5:5", "9:3", "-1:3", "a:b", "1:2:3", "nan:3", "1:inf"}) {
        EXPECT_THROW(app::parseRange(text), base::UsageError) << text;
    }
    app::LookArguments look;
    look.draw.shown = Shown::illuminance;
    look.draw.range = ValueRange{0.0, 1.0};
    EXPECT_THROW(app::checkLook(look), base::UsageError);
    look.draw.scale = ValueScale::linear;
    EXPECT_NO_THROW(app::checkLook(look));
}

TEST(Legend, SaysQuantityUnitAndRoundNumbers) {
    DrawSettings look;
    look.shown = Shown::illuminance;
    const ui::Legend legend = ui::makeLegend(look, {1000.0, 20000.0}, ColorMap());
    EXPECT_EQ(legend.title, "Illuminance, lx");
    ASSERT_EQ(legend.marks.size(), 5u);
    EXPECT_EQ(legend.marks.front().label, "1000");
    EXPECT_EQ(legend.marks.front().place, 0.0);
    EXPECT_EQ(legend.marks.back().label, "20 000");
    EXPECT_EQ(legend.marks.back().place, 1.0);
}

}  // namespace
}  // namespace fluxwalk::render
