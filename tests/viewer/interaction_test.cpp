#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <sys/wait.h>
#include <unistd.h>

#include "viewer/render/color_map.h"

// Drives the program's real window on a screen of its own, and reads what happens in its picture. The moments
// at which things appear depend on the machine: each is waited for.

namespace fluxwalk {
namespace {

using namespace std::chrono_literals;

constexpr int kWidth = 1400;
constexpr int kHeight = 900;

bool isInstalled(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

/// A child process that is ended with its owner.
class Child {
  public:
    /// `output`: a file descriptor that becomes its standard output, or -1.
    explicit Child(const std::vector<std::string>& words, int output = -1) {
        std::vector<char*> arguments;
        for (const std::string& word : words) {
            arguments.push_back(const_cast<char*>(word.c_str()));
        }
        arguments.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            if (output >= 0) {
                dup2(output, 1);
            }
            execvp(arguments[0], arguments.data());
            _exit(127);
        }
    }
    ~Child() {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    bool isRunning() const {
        // Not reaped, so that its number stays its own.
        siginfo_t state{};
        return waitid(P_PID, static_cast<id_t>(process_), &state, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               state.si_pid == 0;
    }

  private:
    pid_t process_ = -1;
};

/// An X server without a screen to look at.
class Screen {
  public:
    Screen() {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) {
            return;
        }
        const std::string size = std::to_string(kWidth) + "x" + std::to_string(kHeight) + "x24";
        server_ =
            std::make_unique<Child>(std::vector<std::string>{"Xvfb", "-displayfd", "1", "-screen", "0", size,
                                                             "+extension", "GLX", "-nolisten", "tcp"},
                                    ends[1]);
        close(ends[1]);
        std::array<char, 16> number{};
        if (read(ends[0], number.data(), number.size() - 1) > 0) {
            setenv("DISPLAY", (":" + std::to_string(std::atoi(number.data()))).c_str(), 1);
            isReady_ = true;
        }
        close(ends[0]);
    }
    bool isReady() const { return isReady_; }

  private:
    std::unique_ptr<Child> server_;
    bool isReady_ = false;
};

struct Pixel {
    int r = 0;
    int g = 0;
    int b = 0;
};

struct Picture {
    std::vector<stbi_uc> bytes;

    Pixel at(int x, int y) const {
        const auto i = static_cast<std::size_t>(3 * (y * kWidth + x));
        return i + 2 < bytes.size() ? Pixel{bytes[i], bytes[i + 1], bytes[i + 2]} : Pixel{};
    }
};

class Window : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const char* program : {"Xvfb", "xdotool", "import"}) {
            if (!isInstalled(program)) {
                GTEST_SKIP() << "no " << program;
            }
        }
        screen_ = std::make_unique<Screen>();
        ASSERT_TRUE(screen_->isReady());
        picture_ =
            std::filesystem::temp_directory_path() / ("fluxwalk-window-" + std::to_string(getpid()) + ".png");
        program_ = std::make_unique<Child>(
            std::vector<std::string>{FLUXWALK_PROGRAM, "view", "cornell-box", "--error", "20%", "--quiet"});
        // The window opens, and the box is lit: its white wall in the middle.
        ASSERT_TRUE(waitFor([](const Picture& p) { return p.at(700, 300).r > 60; }));
    }
    void TearDown() override {
        program_.reset();
        screen_.reset();
        std::filesystem::remove(picture_);
    }

    Picture look() const {
        Picture picture;
        std::system(("import -window root png24:" + picture_.string() + " 2> /dev/null").c_str());
        int width = 0;
        int height = 0;
        int channels = 0;
        const std::unique_ptr<stbi_uc, void (*)(void*)> data(
            stbi_load(picture_.c_str(), &width, &height, &channels, 3), stbi_image_free);
        if (data && width == kWidth && height == kHeight) {
            picture.bytes.assign(data.get(), data.get() + 3 * width * height);
        }
        return picture;
    }
    bool waitFor(const std::function<bool(const Picture&)>& condition) const {
        for (int i = 0; i < 300 && program_->isRunning(); ++i) {
            if (condition(look())) {
                return true;
            }
            std::this_thread::sleep_for(100ms);
        }
        return false;
    }
    /// Held for a while, so that slow frames see it.
    static void press(const std::string& key) {
        act("keydown " + key);
        std::this_thread::sleep_for(300ms);
        act("keyup " + key);
        std::this_thread::sleep_for(300ms);
    }
    static void point(int x, int y) { act("mousemove " + std::to_string(x) + " " + std::to_string(y)); }
    static void act(const std::string& what) { std::system(("xdotool " + what).c_str()); }

    std::unique_ptr<Screen> screen_;
    std::unique_ptr<Child> program_;
    std::filesystem::path picture_;
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
    const auto click = [](int x, int y) {
        point(x, y);
        std::this_thread::sleep_for(150ms);
        act("mousedown 1");
        std::this_thread::sleep_for(200ms);
        act("mouseup 1");
        std::this_thread::sleep_for(400ms);
    };
    // The lamp's row of the panel, as it stands once the box is solved.
    ASSERT_TRUE(waitFor([](const Picture& p) { return partDark(p, 30, 48, 400, 416) < 0.9; }));
    constexpr int row = 408;
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
