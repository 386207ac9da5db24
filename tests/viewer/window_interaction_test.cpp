#include <algorithm>
#include <cmath>

#include "tests/viewer/window_driver.h"

namespace fluxwalk {
namespace {

using namespace std::chrono_literals;
using testing::Picture;
using testing::Pixel;

/// The white wall of the box, and places of the panel.
constexpr int kWallX = 700;
constexpr int kWallY = 300;
constexpr int kExposureX = 169;
constexpr int kExposureY = 698;
constexpr int kLampY = 425;
constexpr int kLampDimX = 200;
constexpr int kLampBrightX = 300;

int brightness(const Picture& p) {
    const Pixel wall = p.at(kWallX, kWallY);
    return wall.r + wall.g + wall.b;
}

/// What is kept goes to the folder where the program is started: here one of the test's own.
class WindowWork : public testing::WindowTest {
  protected:
    void SetUp() override {
        before_ = std::filesystem::current_path();
        folder_ =
            std::filesystem::temp_directory_path() / ("fluxwalk-window-work-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
        std::filesystem::current_path(folder_);
        open({"cornell-box", "--error", "20%", "--quiet"});
        if (!IsSkipped()) {
            ASSERT_TRUE(waitFor([](const Picture& p) { return p.at(kWallX, kWallY).r > 60; }));
        }
    }
    void TearDown() override {
        WindowTest::TearDown();
        std::filesystem::current_path(before_);
        std::filesystem::remove_all(folder_);
    }

    /// The brightness of the wall once it no longer changes.
    int settledBrightness() const {
        int before = -1;
        for (int i = 0; i < 100; ++i) {
            const int now = brightness(look());
            if (std::abs(now - before) <= 1) {
                return now;
            }
            before = now;
            std::this_thread::sleep_for(600ms);
        }
        ADD_FAILURE() << "the picture never stands still";
        return before;
    }
    bool waitForFile(const std::string& name) const {
        return waitFor([&](const Picture&) { return std::filesystem::exists(folder_ / name); });
    }

    std::filesystem::path before_;
    std::filesystem::path folder_;
};

TEST_F(WindowWork, F12KeepsThePictureAndWithShiftItsLight) {
    if (IsSkipped()) {
        return;
    }
    point(900, 850);
    // Not a first guess of the light, which the next frames replace.
    settledBrightness();
    const Picture seen = look();
    press("F12");
    ASSERT_TRUE(waitForFile("cornell-box-1.png"));
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> kept(
        stbi_load((folder_ / "cornell-box-1.png").c_str(), &width, &height, &channels, 3), stbi_image_free);
    ASSERT_TRUE(kept);
    ASSERT_EQ(width, testing::kWidth);
    ASSERT_EQ(height, testing::kHeight);
    // As the window shows it, where no panel is; without the panel where one is.
    const auto at = [&](int x, int y) { return kept.get()[3 * (y * width + x)]; };
    EXPECT_NEAR(at(kWallX, kWallY), seen.at(kWallX, kWallY).r, 6);
    EXPECT_NEAR(at(kWallX, 600), seen.at(kWallX, 600).r, 6);
    EXPECT_NEAR(at(39, kLampY), at(1380, kLampY), 6);

    act("keydown shift");
    press("F12");
    act("keyup shift");
    ASSERT_TRUE(waitForFile("cornell-box-1.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cornell-box-2.png"));
    // Three channels of four bytes are packed, but hardly tenfold.
    EXPECT_GT(std::filesystem::file_size(folder_ / "cornell-box-1.exr"), 200'000u);
    // A second picture spares the first.
    press("F12");
    EXPECT_TRUE(waitForFile("cornell-box-2.png"));
}

TEST_F(WindowWork, AnExposureThatIsHeldShowsThatALampIsDimmed) {
    if (IsSkipped()) {
        return;
    }
    const int before = settledBrightness();
    click(kLampDimX, kLampY);
    // Eyes get used to it.
    point(900, 850);
    std::this_thread::sleep_for(1s);
    EXPECT_NEAR(settledBrightness(), before, 12);
    click(kLampBrightX, kLampY);
    point(900, 850);
    std::this_thread::sleep_for(1s);
    const int bright = settledBrightness();
    click(kExposureX, kExposureY);
    click(kLampDimX, kLampY);
    EXPECT_TRUE(waitFor([&](const Picture& p) { return brightness(p) < bright / 2; }));
    click(kExposureX, kExposureY);
    EXPECT_TRUE(waitFor([&](const Picture& p) { return std::abs(brightness(p) - bright) < 12; }));
}

TEST_F(WindowWork, AnySizeIsFilledAndLeftAgain) {
    if (IsSkipped()) {
        return;
    }
    const auto resize = [](int width, int height) {
        act("search --name Fluxwalk windowsize " + std::to_string(width) + " " + std::to_string(height) +
            " windowmove 0 0");
    };
    const auto isBlack = [](const Pixel& p) { return p.r + p.g + p.b == 0; };
    resize(900, 600);
    // The line of keys has moved to the new corner, and nothing is left of the old one.
    EXPECT_TRUE(waitFor([&](const Picture& p) {
        const Pixel corner = p.at(880, 570);
        return !p.bytes.empty() && isBlack(p.at(1300, 850)) && !isBlack(corner) && corner.r < 60;
    }));
    EXPECT_TRUE(waitFor([&](const Picture& p) { return p.at(450, 200).r > 60; }));
    for (const auto& [width, height] : {std::pair(40, 30), std::pair(1, 1), std::pair(1400, 20)}) {
        resize(width, height);
        std::this_thread::sleep_for(400ms);
        ASSERT_TRUE(program_->isRunning());
    }
    resize(testing::kWidth, testing::kHeight);
    EXPECT_TRUE(
        waitFor([&](const Picture& p) { return p.at(kWallX, kWallY).r > 60 && !isBlack(p.at(1300, 850)); }));
}

}  // namespace
}  // namespace fluxwalk
