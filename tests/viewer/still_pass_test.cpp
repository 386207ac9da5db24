#include "viewer/render/still_pass.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "viewer/app/still_file.h"
#include "viewer/gl/context.h"

namespace fluxwalk::render {
namespace {

constexpr gl::PixelSize kSize{37, 23};
constexpr double kExposure = 0.01;

/// From dark to far brighter than white.
std::vector<float> makeLuminance(gl::PixelSize size) {
    base::RandomStream random(3);
    std::vector<float> luminance(static_cast<std::size_t>(3 * size.width * size.height));
    for (float& value : luminance) {
        value = static_cast<float>(std::exp2(16.0 * random.next() - 6.0));
    }
    return luminance;
}

/// Rows and columns [left, left + width) x [top, top + height) of a picture.
std::vector<float> cut(const std::vector<float>& luminance, const StillPass::Place& place) {
    std::vector<float> part;
    for (std::uint32_t y = place.top; y < place.top + place.height; ++y) {
        const auto first = luminance.begin() + 3 * (static_cast<long>(y) * kSize.width + place.left);
        part.insert(part.end(), first, first + 3 * static_cast<long>(place.width));
    }
    return part;
}

image::Still stillOf(const std::vector<float>& luminance) {
    image::Still still;
    still.width = kSize.width;
    still.height = kSize.height;
    still.luminance = luminance;
    return still;
}

class Pass : public ::testing::TestWithParam<gl::HeadlessKind> {
  protected:
    Pass()
        : context_(gl::makeHeadlessContext(GetParam())),
          gl_(context_->functions()),
          target_(gl_, kSize, 1),
          under_(gl_, kSize, 1, gl::PixelFormat::full) {
        under_.bind();
        gl_.ClearColor(100.0f, 0.0f, 0.0f, 1.0f);
        gl_.Clear(GL_COLOR_BUFFER_BIT);
    }

    std::unique_ptr<gl::Context> context_;
    const gl::Functions& gl_;
    gl::RenderTarget target_;
    gl::RenderTarget under_;
};

TEST_P(Pass, ShowsAStillAsItsFileWillShowIt) {
    const std::vector<float> luminance = makeLuminance(kSize);
    StillPass pass(gl_, kSize);
    // In four parts, of odd widths.
    for (const StillPass::Place& place :
         {StillPass::Place{0, 0, 20, 10}, {20, 0, 17, 10}, {0, 10, 5, 13}, {5, 10, 32, 13}}) {
        pass.put(place, cut(luminance, place));
    }
    for (const ToneCurve curve :
         {ToneCurve::linear, ToneCurve::filmic, ToneCurve::reinhard, ToneCurve::hue}) {
        pass.draw(target_, under_, {kExposure, curve});
        const std::vector<std::uint8_t> shown = target_.readRgb();
        const std::vector<std::uint8_t> wanted = app::developStill(stillOf(luminance), kExposure, curve);
        ASSERT_EQ(shown.size(), wanted.size());
        for (std::size_t i = 0; i < shown.size(); ++i) {
            EXPECT_NEAR(shown[i], wanted[i], 1) << i;
        }
    }
    EXPECT_EQ(gl_.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(Pass, WhatIsNotMadeShowsWhatLiesUnderIt) {
    StillPass pass(gl_, kSize);
    pass.draw(target_, under_, {0.005, ToneCurve::linear});
    const auto at = [&](int x, int y) {
        const std::vector<std::uint8_t> shown = target_.readRgb();
        const auto i = static_cast<std::size_t>(3 * (y * kSize.width + x));
        return std::array<int, 3>{shown[i], shown[i + 1], shown[i + 2]};
    };
    const auto half = static_cast<int>(std::lround(255.0f * encodeSrgb(0.5f)));
    EXPECT_NEAR(at(3, 4)[0], half, 1);
    EXPECT_LE(at(3, 4)[1], 1);
    // The upper left corner is made, and green.
    const StillPass::Place corner{0, 0, 8, 8};
    std::vector<float> green;
    for (int i = 0; i < 64; ++i) {
        green.insert(green.end(), {0.0f, 100.0f, 0.0f});
    }
    pass.put(corner, green);
    pass.draw(target_, under_, {0.005, ToneCurve::linear});
    EXPECT_LE(at(3, 4)[0], 1);
    EXPECT_NEAR(at(3, 4)[1], half, 1);
    EXPECT_LE(at(7, 7)[0], 1);
    EXPECT_NEAR(at(8, 7)[0], half, 1);
    EXPECT_NEAR(at(7, 8)[0], half, 1);
    EXPECT_NEAR(at(3, 20)[0], half, 1);
}

// Columns of one pixel, bright and dark, seen four times smaller: even, not striped.
TEST_P(Pass, SmallerStillsAreAveraged) {
    constexpr int kMany = 4;
    const gl::PixelSize large{kMany * kSize.width, kMany * kSize.height};
    std::vector<float> stripes;
    for (int i = 0; i < large.width * large.height; ++i) {
        const float value = i % large.width % 2 == 0 ? 100.0f : 0.0f;
        stripes.insert(stripes.end(), {value, value, value});
    }
    StillPass pass(gl_, large);
    pass.put({0, 0, static_cast<std::uint32_t>(large.width), static_cast<std::uint32_t>(large.height)},
             stripes);
    pass.draw(target_, under_, {kExposure, ToneCurve::linear});
    const auto half = static_cast<int>(std::lround(255.0f * encodeSrgb(0.5f)));
    for (const std::uint8_t value : target_.readRgb()) {
        ASSERT_NEAR(value, half, 2);
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, Pass, ::testing::Values(gl::HeadlessKind::egl, gl::HeadlessKind::osmesa));

}  // namespace
}  // namespace fluxwalk::render
