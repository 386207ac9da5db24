#include <cmath>
#include <fstream>

#include "core/io/visitor_files.h"
#include "tests/viewer/window_driver.h"
#include "tests/viewer/x_client.h"

namespace fluxwalk {
namespace {

using namespace std::chrono_literals;
using testing::kHeight;
using testing::kWidth;
using testing::Picture;

/// Mean difference of two pictures right of the panel and above the line of keys, levels of 255.
double difference(const Picture& a, const Picture& b) {
    double sum = 0.0;
    int count = 0;
    for (int y = 120; y < kHeight - 120; y += 3) {
        for (int x = 420; x < kWidth - 20; x += 3) {
            sum += std::abs(a.at(x, y).r - b.at(x, y).r) + std::abs(a.at(x, y).g - b.at(x, y).g) +
                   std::abs(a.at(x, y).b - b.at(x, y).b);
            count += 3;
        }
    }
    return sum / count;
}
constexpr double kSame = 2.0;
constexpr double kOther = 6.0;

/// Part of the field in which messages appear that is as dark as their ground.
double partMessage(const Picture& picture) {
    int dark = 0;
    int all = 0;
    for (int y = 20; y < 44; ++y) {
        for (int x = 560; x < 840; x += 2) {
            const testing::Pixel p = picture.at(x, y);
            const int most = std::max({p.r, p.g, p.b});
            dark += most > 10 && most < 45 && std::abs(p.r - p.b) < 6 ? 1 : 0;
            ++all;
        }
    }
    return static_cast<double>(dark) / all;
}

class Walk : public testing::WindowTest {
  protected:
    void open(const std::vector<std::string>& arguments) {
        WindowTest::open(arguments);
        if (!IsSkipped() && !HasFatalFailure()) {
            // Before the first light it is as dark as the background.
            ASSERT_TRUE(waitFor([](const Picture& p) {
                const testing::Pixel middle = p.at(900, 500);
                return middle.r + middle.g + middle.b > 150;
            }));
        }
    }
    /// The picture once it stays as it is.
    Picture settled() {
        Picture before = look();
        for (int i = 0; i < 200; ++i) {
            std::this_thread::sleep_for(400ms);
            Picture now = look();
            if (difference(before, now) < 0.05) {
                return now;
            }
            before = std::move(now);
        }
        ADD_FAILURE() << "the picture never stands still";
        return before;
    }
    static void hold(const std::string& key, std::chrono::milliseconds time) {
        act("keydown " + key);
        std::this_thread::sleep_for(time);
        act("keyup " + key);
    }
};

TEST_F(Walk, TheVisitorWalksUntilTheWall) {
    // Objects in flat colours: walls of one hue would look alike from everywhere.
    open({"gallery", "--eye", "2,1.6,4.5", "--target", "2,1.6,0", "--error", "50%", "--show", "objects",
          "--quiet"});
    if (IsSkipped()) {
        return;
    }
    point(900, 500);
    const Picture start = settled();
    hold("w", 1500ms);
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, start) > kOther; }));
    hold("w", 6000ms);
    const Picture wall = settled();
    hold("w", 2000ms);
    EXPECT_LT(difference(settled(), wall), 0.5);
    hold("s", 1500ms);
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, wall) > kOther; }));
}

TEST_F(Walk, BookmarksOrbitsAndPathsLeadBack) {
    open({"cornell-box", "--error", "20%", "--quiet"});
    if (IsSkipped()) {
        return;
    }
    point(900, 500);
    const Picture start = settled();
    press("b");
    EXPECT_TRUE(waitFor([](const Picture& p) { return partMessage(p) > 0.6; }));
    EXPECT_FALSE(std::filesystem::is_empty(state_ / "fluxwalk" / "bookmarks"));
    act("keydown alt mousedown 1");
    for (int i = 1; i <= 10; ++i) {
        point(900 + 12 * i, 500 + 3 * i);
        std::this_thread::sleep_for(50ms);
    }
    act("mouseup 1 keyup alt");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, start) > kOther; }));
    press("1");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, start) < kSame; }));
    // To the short block, and back.
    point(820, 680);
    press("g");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, start) > kOther; }));
    std::this_thread::sleep_for(1s);
    press("1");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, start) < kSame; }));

    press("r");
    hold("d", 1500ms);
    std::this_thread::sleep_for(300ms);
    press("r");
    const auto file = state_ / "fluxwalk" / "paths" / "path-1.json";
    EXPECT_TRUE(waitFor([&](const Picture&) { return std::filesystem::exists(file); }));
    const scene::CameraPath path = io::readCameraPath(file);
    EXPECT_GT(path.size(), 3u);
    EXPECT_GT(glm::length(path.back().camera.position - path.front().camera.position), 0.05);
    const Picture end = settled();
    EXPECT_GT(difference(end, start), kOther);
    press("l");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, end) > kOther; }));
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, end) < kSame; }));
}

TEST_F(Walk, ABadFileIsNamedAndTheSceneStaysAGoodOneIsOpened) {
    open({"cornell-box", "--error", "20%", "--quiet"});
    if (IsSkipped()) {
        return;
    }
    const Picture start = settled();
    const auto bad = state_ / "bad.glb";
    std::ofstream(bad) << "glTF but not really";
    ASSERT_TRUE(testing::dropFile(bad.string()));
    EXPECT_TRUE(waitFor([](const Picture& p) { return partMessage(p) > 0.5; }));
    EXPECT_LT(difference(settled(), start), kSame);
    press("Escape");
    EXPECT_TRUE(waitFor([](const Picture& p) { return partMessage(p) < 0.3; }));
    ASSERT_TRUE(testing::dropFile(std::string(FLUXWALK_SOURCE_DIR) + "/assets/gallery.glb"));
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, start) > 20.0; }));
    const auto recent = io::readRecentFiles(state_ / "fluxwalk" / "recent.json");
    ASSERT_EQ(recent.size(), 1u);
    EXPECT_TRUE(recent[0].ends_with("/assets/gallery.glb"));
    // Left while it is still being solved.
    ASSERT_TRUE(testing::closeWindow());
    for (int i = 0; i < 600 && program_->isRunning(); ++i) {
        std::this_thread::sleep_for(100ms);
    }
    EXPECT_EQ(program_->exitStatus(), 0);
}

TEST_F(Walk, F11FillsTheScreenAndF1ShowsTheKeys) {
    open({"cornell-box", "--error", "20%", "--quiet"});
    if (IsSkipped()) {
        return;
    }
    act("search --name Fluxwalk windowsize 1000 700 windowmove 0 0");
    const auto isBlack = [](const Picture& p) {
        const testing::Pixel corner = p.at(1200, 850);
        return !p.bytes.empty() && corner.r + corner.g + corner.b == 0;
    };
    EXPECT_TRUE(waitFor(isBlack));
    point(700, 500);
    press("F11");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return !p.bytes.empty() && !isBlack(p); }));
    const Picture full = settled();
    press("F1");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, full) > 10.0; }));
    // Pressed and released at once, sooner than a frame.
    act("key F1");
    EXPECT_TRUE(waitFor([&](const Picture& p) { return difference(p, full) < kSame; }));
    press("F11");
    EXPECT_TRUE(waitFor(isBlack));
}

TEST_F(Walk, TheWindowClosesWhileItSolves) {
    open({"gallery", "--error", "0.5%", "--quiet"});
    if (IsSkipped()) {
        return;
    }
    ASSERT_TRUE(testing::closeWindow());
    for (int i = 0; i < 600 && program_->isRunning(); ++i) {
        std::this_thread::sleep_for(100ms);
    }
    EXPECT_EQ(program_->exitStatus(), 0);
}

}  // namespace
}  // namespace fluxwalk
