#include <array>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/cli/command.h"

namespace fluxwalk {
namespace {

namespace fs = std::filesystem;

/// `fluxwalk render` as it is run in a shell, where Ctrl-C is a signal.
class RenderInterrupt : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("fluxwalk-interrupt-" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        if (told_ >= 0) {
            close(told_);
        }
        fs::remove_all(folder_);
    }

    void start(const std::vector<std::string>& words) {
        std::array<int, 2> ends{};
        ASSERT_EQ(pipe(ends.data()), 0);
        std::vector<char*> arguments;
        for (const std::string& word : words) {
            arguments.push_back(const_cast<char*>(word.c_str()));
        }
        arguments.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            dup2(ends[1], 2);
            close(ends[0]);
            close(ends[1]);
            execv(arguments[0], arguments.data());
            _exit(127);
        }
        close(ends[1]);
        told_ = ends[0];
    }
    /// Reads what the program tells until a word comes; false where it ends before.
    bool waitFor(const std::string& word) {
        std::array<char, 256> part{};
        while (text_.find(word) == std::string::npos) {
            const ssize_t count = read(told_, part.data(), part.size());
            if (count <= 0) {
                return false;
            }
            text_.append(part.data(), static_cast<std::size_t>(count));
        }
        return true;
    }
    /// How it ended, as waitpid() says.
    int end() const {
        int state = 0;
        waitpid(process_, &state, 0);
        return state;
    }

    fs::path folder_;
    pid_t process_ = -1;
    int told_ = -1;
    std::string text_;
};

TEST_F(RenderInterrupt, TheFirstKeepsTheRowsThatAreDone) {
    const fs::path file = folder_ / "out.png";
    start({FLUXWALK_PROGRAM, "render", "cornell-box", "--error", "50%", "--size", "2000x3000", "--eye",
           ".278,.4,.1", "--target", ".278,.4,.5", "--fov", "40", "-o", file});
    ASSERT_TRUE(waitFor("gathering")) << text_;
    kill(process_, SIGINT);
    const int state = end();
    ASSERT_TRUE(WIFEXITED(state));
    EXPECT_EQ(WEXITSTATUS(state), static_cast<int>(cli::ExitCode::interrupted));
    // Nothing else is left in the folder.
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> kept(
        stbi_load(file.c_str(), &width, &height, &channels, 3), stbi_image_free);
    ASSERT_TRUE(kept);
    ASSERT_EQ(width, 2000);
    ASSERT_EQ(height, 3000);
    const auto meanOfRow = [&](int y) {
        double sum = 0.0;
        for (int i = 0; i < 3 * width; ++i) {
            sum += kept.get()[3 * y * width + i];
        }
        return sum / (3 * width);
    };
    // From within the box every row sees its walls.
    EXPECT_GT(meanOfRow(0), 5.0) << "nothing is done";
    EXPECT_LT(meanOfRow(height - 1), 1.0) << "all is done";
}

}  // namespace
}  // namespace fluxwalk
