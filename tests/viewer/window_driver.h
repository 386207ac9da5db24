#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <sys/wait.h>
#include <unistd.h>

/// Drives the program's real window on a screen of its own, and reads what happens in its picture. The
/// moments at which things appear depend on the machine: each is waited for.
namespace fluxwalk::testing {

using namespace std::chrono_literals;

constexpr int kWidth = 1400;
constexpr int kHeight = 900;

inline bool isInstalled(const std::string& program) {
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

    /// Its exit status; nothing while it runs or where a signal ended it.
    std::optional<int> exitStatus() const {
        siginfo_t state{};
        const bool isKnown =
            waitid(P_PID, static_cast<id_t>(process_), &state, WEXITED | WNOHANG | WNOWAIT) == 0;
        return isKnown && state.si_pid != 0 && state.si_code == CLD_EXITED ? std::optional(state.si_status)
                                                                           : std::nullopt;
    }

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

/// A test with a screen, keys and a mouse. What the program keeps goes to a folder of the test's.
class WindowTest : public ::testing::Test {
  protected:
    /// Shows a scene; `arguments` follow "view". Skips the test where there is no X server.
    void open(const std::vector<std::string>& arguments) {
        for (const char* program : {"Xvfb", "xdotool", "import"}) {
            if (!isInstalled(program)) {
                GTEST_SKIP() << "no " << program;
            }
        }
        screen_ = std::make_unique<Screen>();
        ASSERT_TRUE(screen_->isReady());
        const std::string name = "fluxwalk-window-" + std::to_string(getpid());
        picture_ = std::filesystem::temp_directory_path() / (name + ".ppm");
        state_ = std::filesystem::temp_directory_path() / (name + "-state");
        std::filesystem::create_directories(state_);
        setenv("XDG_STATE_HOME", state_.c_str(), 1);
        std::vector<std::string> words{FLUXWALK_PROGRAM, "view"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        program_ = std::make_unique<Child>(words);
    }
    void TearDown() override {
        program_.reset();
        screen_.reset();
        std::filesystem::remove(picture_);
        std::filesystem::remove_all(state_);
    }

    Picture look() const {
        Picture picture;
        std::system(("import -window root ppm:" + picture_.string() + " 2> /dev/null").c_str());
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
    static void click(int x, int y) {
        point(x, y);
        std::this_thread::sleep_for(150ms);
        act("mousedown 1");
        std::this_thread::sleep_for(200ms);
        act("mouseup 1");
        std::this_thread::sleep_for(400ms);
    }
    static void act(const std::string& what) { std::system(("xdotool " + what).c_str()); }

    std::unique_ptr<Screen> screen_;
    std::unique_ptr<Child> program_;
    std::filesystem::path picture_;
    std::filesystem::path state_;
};

}  // namespace fluxwalk::testing
