#include <cstdlib>
#include <string>

#include "tests/viewer/window_driver.h"
#include "viewer/render/color_map.h"

namespace fluxwalk {
namespace {

using namespace std::chrono_literals;
using testing::Picture;
using testing::Pixel;

class Window : public testing::WindowTest {
  protected:
    void SetUp() override {
        open({"cornell-box", "--error", "20%", "--quiet"});
        // The window opens, and the box is lit: its white wall in the middle.
        if (!IsSkipped()) {
            ASSERT_TRUE(waitFor([](const Picture& p) { return p.at(700, 300).r > 60; }));
        }
    }
};

/// Distance of a colour from the nearest one of the colour map.
int distanceFromMap(const Pixel& pixel) {
    static const render::ColorMap map;
    int nearest = 3 * 255;
    for (const render::Color8& color : map.colors()) {
        nearest = std::min(nearest, std::abs(pixel.r - color[0]) + std::abs(pixel.g - color[1]) +
                                        std::abs(pixel.b - color[2]));
    }
    return nearest;
}

/// How much of a part of the window has colours of the map.
double partInMap(const Picture& picture, int left, int right, int top, int bottom) {
    int inMap = 0;
    int all = 0;
    for (int y = top; y < bottom; y += 4) {
        for (int x = left; x < right; x += 4) {
            ++all;
            inMap += distanceFromMap(picture.at(x, y)) <= 4 ? 1 : 0;
        }
    }
    return static_cast<double>(inMap) / all;
}

/// How much of a part of the window is as dark as panels and readouts are.
double partDark(const Picture& picture, int left, int right, int top, int bottom) {
    int dark = 0;
    int all = 0;
    for (int y = top; y < bottom; y += 2) {
        for (int x = left; x < right; x += 2) {
            const Pixel p = picture.at(x, y);
            ++all;
            dark += std::max({p.r, p.g, p.b}) < 45 && std::max({p.r, p.g, p.b}) > 10 ? 1 : 0;
        }
    }
    return static_cast<double>(dark) / all;
}

TEST_F(Window, CShowsIlluminanceAndThePictureAgain) {
    const auto inBox = [](const Picture& p) { return partInMap(p, 550, 900, 250, 600); };
    EXPECT_LT(inBox(look()), 0.3);
    press("c");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return inBox(p) > 0.8; }));
    // The legend in the lower right corner: a dark field.
    EXPECT_GT(partDark(look(), 1300, 1380, 520, 810), 0.5);
    press("c");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return inBox(p) < 0.3; }));
}

TEST_F(Window, IReadsThePointUnderTheCursor) {
    // Right below the cursor, where the readout appears.
    const auto beside = [](const Picture& p, int x, int y) {
        return partDark(p, x + 18, x + 180, y + 18, y + 80);
    };
    point(700, 300);
    EXPECT_LT(beside(look(), 700, 300), 0.3);
    press("i");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return beside(p, 700, 300) > 0.6; }));
    // It follows, and the other place is free again.
    point(600, 500);
    EXPECT_TRUE(
        waitFor([&](const Picture& p) { return beside(p, 600, 500) > 0.6 && beside(p, 700, 300) < 0.3; }));
    // A click pins it.
    act("mousedown 1");
    std::this_thread::sleep_for(300ms);
    act("mouseup 1");
    std::this_thread::sleep_for(300ms);
    point(700, 300);
    std::this_thread::sleep_for(1s);
    EXPECT_GT(beside(look(), 600, 500), 0.6);
    press("i");
    EXPECT_TRUE(
        waitFor([&](const Picture& p) { return beside(p, 600, 500) < 0.3 && beside(p, 700, 300) < 0.3; }));
}

TEST_F(Window, LampsAreSwitchedAndDimmedInThePanel) {
    const auto isLit = [](const Picture& p) { return p.at(700, 300).r > 60; };
    const auto isDark = [](const Picture& p) { return p.at(700, 300).r < 8; };
    // The lamp's row of the panel.
    constexpr int row = 425;
    ASSERT_LT(partDark(look(), 30, 48, row - 8, row + 8), 0.9);
    click(39, row);
    ASSERT_TRUE(waitFor(isDark));
    click(39, row);
    EXPECT_TRUE(waitFor(isLit));
    // The left end of its slider is 0 %, the middle is not.
    click(160, row);
    EXPECT_TRUE(waitFor(isDark));
    click(250, row);
    EXPECT_TRUE(waitFor(isLit));
}

}  // namespace
}  // namespace fluxwalk
