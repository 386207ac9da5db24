#include "viewer/render/tone.h"

#include <array>

#include <gtest/gtest.h>

namespace fluxwalk::render {
namespace {

constexpr std::array kCurves{ToneCurve::linear, ToneCurve::filmic, ToneCurve::reinhard};

TEST(ToneCurve, FilmicGoesThroughItsPoints) {
    const std::array<std::array<float, 2>, 4> points{
        {{0.0f, 0.0f}, {0.18f, 0.18f}, {1.0f, 0.782f}, {8.0f, 0.99f}}};
    for (const auto& [x, y] : points) {
        EXPECT_NEAR(applyToneCurve(base::Rgb(x), ToneCurve::filmic).g, y, 5e-4f) << x;
    }
    EXPECT_NEAR(applyToneCurve(base::Rgb(1e-4f), ToneCurve::filmic).g / 1e-4f, 0.6f, 1e-2f);
}

TEST(ToneCurve, LinearKeepsAndReinhardHasItsWhite) {
    EXPECT_EQ(applyToneCurve(base::Rgb(0.4f, 2.0f, 0.0f), ToneCurve::linear), base::Rgb(0.4f, 2.0f, 0.0f));
    EXPECT_NEAR(applyToneCurve(base::Rgb(4.0f), ToneCurve::reinhard).r, 1.0f, 1e-5f);
    const base::Rgb color = applyToneCurve({0.9f, 0.3f, 0.1f}, ToneCurve::reinhard);
    EXPECT_NEAR(color.r / color.g, 3.0f, 1e-5f);
    EXPECT_NEAR(color.g / color.b, 3.0f, 1e-5f);
}

TEST(ToneCurve, AllRiseAndStartAtBlack) {
    for (const ToneCurve curve : kCurves) {
        EXPECT_EQ(applyToneCurve(base::Rgb(0.0f), curve).r, 0.0f);
        float last = 0.0f;
        for (float x = 0.001f; x < 100.0f; x *= 1.05f) {
            const float y = applyToneCurve(base::Rgb(x), curve).r;
            EXPECT_GT(y, last) << x;
            last = y;
        }
    }
    EXPECT_LT(applyToneCurve(base::Rgb(1e6f), ToneCurve::filmic).r, 1.0001f);
}

TEST(Srgb, KnownValuesAndInverse) {
    EXPECT_NEAR(encodeSrgb(0.2140411f), 0.5f, 1e-5f);
    EXPECT_EQ(encodeSrgb(-1.0f), 0.0f);
    EXPECT_NEAR(encodeSrgb(7.0f), 1.0f, 1e-6f);
    for (int byte = 0; byte < 256; ++byte) {
        EXPECT_NEAR(encodeSrgb(decodeSrgb(static_cast<std::uint8_t>(byte))) * 255.0f,
                    static_cast<float>(byte), 1e-2f);
    }
}

}  // namespace
}  // namespace fluxwalk::render
