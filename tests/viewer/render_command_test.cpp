#include "viewer/app/render_command.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/image/final_gather.h"
#include "viewer/app/still_file.h"

namespace fluxwalk::app {
namespace {

namespace fs = std::filesystem;

class RenderCommand : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("fluxwalk_render_" + std::to_string(getpid()));
        fs::create_directory(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    int run(std::vector<std::string> words) {
        words.insert(words.begin(), {"fluxwalk", "render"});
        std::vector<const char*> arguments;
        for (const std::string& word : words) {
            arguments.push_back(word.c_str());
        }
        ::testing::internal::CaptureStderr();
        const int code =
            cli::runCommandLine(static_cast<int>(arguments.size()), arguments.data(), {renderCommand()});
        told_ = ::testing::internal::GetCapturedStderr();
        return code;
    }

    static std::string contentOf(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    fs::path folder_;
    std::string told_;
};

TEST_F(RenderCommand, BadInputIsToldInOneLineAndLeavesNothing) {
    const std::string png = folder_ / "out.png";
    const auto expectRefused = [&](const std::vector<std::string>& words, int code, const std::string& why) {
        EXPECT_EQ(run(words), code) << why;
        EXPECT_NE(told_.find(why), std::string::npos) << told_;
        EXPECT_EQ(std::count(told_.begin(), told_.end(), '\n'), 1) << told_;
        EXPECT_TRUE(fs::is_empty(folder_)) << why;
    };
    const int usage = static_cast<int>(cli::ExitCode::usage);
    expectRefused({"cornell-box", "--camera", "nobody", "-o", png}, usage, "front");
    expectRefused({"cornell-box", "--size", "16000x16000", "-o", png}, usage, "7680x4320");
    expectRefused({"cornell-box", "--size", "0x9", "-o", png}, usage, "--size");
    expectRefused({"cornell-box", "-o", folder_ / "out.jpg"}, usage, ".exr");
    expectRefused({"cornell-box", "--half", "-o", png}, usage, "--half");
    expectRefused({"cornell-box", "--exposure", "3", "-o", folder_ / "out.exr"}, usage, "--exposure");
    expectRefused({"cornell-box", "--shadow-rays", "2", "-o", png}, usage, "--shadow-rays");
    expectRefused({"cornell-box", "--eye", "1,1,1", "--target", "1,1,1", "-o", png}, usage, "target");
    expectRefused({"cornell-box", "-o", folder_ / "missing" / "out.png"},
                  static_cast<int>(cli::ExitCode::cannotWrite), "cannot be written");
    expectRefused({folder_ / "missing.glb", "-o", png}, static_cast<int>(cli::ExitCode::badInput),
                  "missing.glb");
}

// Writing fails at the end, as where a disk is full.
TEST_F(RenderCommand, AFullDiskIsToldAndLeavesNothing) {
    if (!fs::exists("/dev/full")) {
        GTEST_SKIP() << "no /dev/full";
    }
    fs::create_symlink("/dev/full", folder_ / "out.png");
    EXPECT_EQ(run({"cornell-box", "--size", "64x64", "--error", "50%", "--quiet", "-o", folder_ / "out.png"}),
              static_cast<int>(cli::ExitCode::cannotWrite));
    EXPECT_NE(told_.find("cannot be written"), std::string::npos) << told_;
}

TEST_F(RenderCommand, WritesBothKinds) {
    const std::vector<std::string> rough{"cornell-box", "--size", "40x30", "--error", "50%", "--quiet"};
    for (const char* name : {"out.png", "out.exr"}) {
        std::vector<std::string> words = rough;
        words.insert(words.end(), {"-o", folder_ / name});
        EXPECT_EQ(run(words), 0) << told_;
    }
    EXPECT_EQ(contentOf(folder_ / "out.png").substr(1, 3), "PNG");
    const std::string exr = contentOf(folder_ / "out.exr");
    EXPECT_EQ(exr.substr(0, 4), "\x76\x2f\x31\x01");
    for (const char* channel : {"irradiance.R", "albedo.G", "normal.Z", "object.id", "whiteLuminance"}) {
        EXPECT_NE(exr.find(channel), std::string::npos) << channel;
    }
    std::vector<std::string> words = rough;
    words.insert(words.end(), {"--half", "-o", folder_ / "half.exr"});
    EXPECT_EQ(run(words), 0) << told_;
    EXPECT_LT(fs::file_size(folder_ / "half.exr"), fs::file_size(folder_ / "out.exr"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 3);
}

TEST(StillFile, DevelopsAsTheViewerDoes) {
    image::Still still;
    still.width = 2;
    still.height = 1;
    still.luminance = {0.0f, 0.0f, 0.0f, 100.0f, 100.0f, 100.0f};
    still.irradiance.assign(6, 0.0f);
    still.albedo.assign(6, 0);
    still.normal.assign(6, 0);
    still.object = {0, 1};
    const auto pixels = developStill(still, 0.01, render::ToneCurve::linear);
    EXPECT_LE(pixels[0], 1);
    EXPECT_GE(pixels[3], 254);
    // All that is lit shines by itself: it comes to the bright level.
    EXPECT_NEAR(meterStill(still), 0.0085, 0.001);
}

}  // namespace
}  // namespace fluxwalk::app
