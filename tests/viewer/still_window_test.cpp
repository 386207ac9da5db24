#include <cmath>
#include <fstream>
#include <iterator>

#include "tests/viewer/window_driver.h"
#include "tests/viewer/x_client.h"

namespace fluxwalk {
namespace {

using namespace std::chrono_literals;
using testing::Picture;
using testing::Pixel;

/// The white wall of the box, and the left end of the progress in the bar of a large still: as soon as some
/// of it is done.
constexpr int kWallX = 700;
constexpr int kWallY = 300;
constexpr int kBarX = 627;
constexpr int kBarY = 784;
constexpr Pixel kProgress{245, 184, 92};
/// The middle of a small still, and the first of its buttons. Nothing but background is there otherwise.
constexpr int kSmallX = 1204;
constexpr int kSmallY = 155;
constexpr int kFirstButtonX = 1065;
constexpr int kFirstButtonY = 315;

int sumOf(const Pixel& p) {
    return p.r + p.g + p.b;
}
bool hasBar(const Picture& p) {
    const Pixel bar = p.at(kBarX, kBarY);
    const auto isNear = [](int a, int b) { return std::abs(a - b) < 8; };
    return isNear(bar.r, kProgress.r) && isNear(bar.g, kProgress.g) && isNear(bar.b, kProgress.b);
}
bool isSmall(const Picture& p) {
    return sumOf(p.at(kSmallX, kSmallY)) > 200;
}

/// What is kept goes to the folder where the program is started: here one of the test's own.
class StillWindow : public testing::WindowTest {
  protected:
    void SetUp() override {
        before_ = std::filesystem::current_path();
        folder_ =
            std::filesystem::temp_directory_path() / ("fluxwalk-still-window-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
        std::filesystem::current_path(folder_);
        open({"cornell-box", "--error", "20%", "--quiet"});
        if (!IsSkipped()) {
            ASSERT_TRUE(waitFor([](const Picture& p) { return p.at(kWallX, kWallY).r > 60; }));
            point(900, 500);
            ASSERT_FALSE(hasBar(look()));
        }
    }
    void TearDown() override {
        WindowTest::TearDown();
        std::filesystem::current_path(before_);
        std::filesystem::remove_all(folder_);
    }
    /// Does something until a file is there.
    bool repeatUntil(const std::function<void()>& act, const std::string& name) const {
        for (int i = 0; i < 200 && program_->isRunning(); ++i) {
            act();
            for (int k = 0; k < 10; ++k) {
                if (std::filesystem::exists(folder_ / name)) {
                    return true;
                }
                std::this_thread::sleep_for(100ms);
            }
        }
        return false;
    }

    std::filesystem::path before_;
    std::filesystem::path folder_;
};

TEST_F(StillWindow, AStillFillsInIsKeptAndDismissed) {
    if (IsSkipped()) {
        return;
    }
    press("t");
    ASSERT_TRUE(waitFor(hasBar));
    // While it is made nothing is kept; a message says why.
    ASSERT_TRUE(repeatUntil([] { press("F12"); }, "cornell-box-still-1.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cornell-box-1.png"));
    const Picture seen = look();
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> kept(
        stbi_load((folder_ / "cornell-box-still-1.png").c_str(), &width, &height, &channels, 3),
        stbi_image_free);
    ASSERT_TRUE(kept);
    ASSERT_EQ(width, testing::kWidth);
    ASSERT_EQ(height, testing::kHeight);
    // Pixel by pixel as the window shows it, right of the panel and above the bar.
    int worst = 0;
    for (int y = 80; y < 730; y += 3) {
        for (int x = 400; x < 1390; x += 3) {
            const stbi_uc* pixel = kept.get() + 3 * (y * width + x);
            const Pixel shown = seen.at(x, y);
            worst = std::max({worst, std::abs(pixel[0] - shown.r), std::abs(pixel[1] - shown.g),
                              std::abs(pixel[2] - shown.b)});
        }
    }
    EXPECT_LE(worst, 2);

    act("keydown shift");
    press("F12");
    act("keyup shift");
    ASSERT_TRUE(repeatUntil([] {}, "cornell-box-still-1.exr"));
    std::ifstream stream(folder_ / "cornell-box-still-1.exr", std::ios::binary);
    const std::string light{std::istreambuf_iterator<char>(stream), {}};
    for (const char* layer : {"irradiance.R", "albedo.G", "normal.Z", "object.id"}) {
        EXPECT_NE(light.find(layer), std::string::npos) << layer;
    }
    press("Escape");
    EXPECT_TRUE(waitFor([](const Picture& p) { return !hasBar(p) && p.at(kWallX, kWallY).r > 60; }));
}

TEST_F(StillWindow, WhileOneWalksItIsInTheCornerAndCancelledItKeepsWhatIsDone) {
    if (IsSkipped()) {
        return;
    }
    press("t");
    ASSERT_TRUE(waitFor(hasBar));
    press("s");
    EXPECT_TRUE(waitFor([](const Picture& p) { return !hasBar(p) && isSmall(p); }));
    // The same button cancels and, once it is over, saves.
    ASSERT_TRUE(repeatUntil([] { click(kFirstButtonX, kFirstButtonY); }, "cornell-box-still-1.png"));
    point(900, 500);
    press("t");
    EXPECT_TRUE(waitFor(hasBar));
    press("Escape");
    EXPECT_TRUE(waitFor([](const Picture& p) { return !hasBar(p) && !isSmall(p); }));
}

TEST_F(StillWindow, AnotherSceneOrTheEndComeAtAnyMoment) {
    if (IsSkipped()) {
        return;
    }
    press("t");
    ASSERT_TRUE(waitFor(hasBar));
    ASSERT_TRUE(testing::dropFile(std::string(FLUXWALK_SOURCE_DIR) + "/assets/gallery.glb"));
    EXPECT_TRUE(waitFor([](const Picture& p) { return !hasBar(p) && sumOf(p.at(900, 500)) > 150; }));
    press("t");
    std::this_thread::sleep_for(1s);
    ASSERT_TRUE(testing::closeWindow());
    for (int i = 0; i < 600 && program_->isRunning(); ++i) {
        std::this_thread::sleep_for(100ms);
    }
    EXPECT_EQ(program_->exitStatus(), 0);
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace fluxwalk
