#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/cli/command.h"

namespace fluxwalk::cli {

/// What a command left.
struct Result {
    int code = -1;
    std::string out;
    std::string err;
};

/// A folder for files, and commands run as they are typed.
class CommandTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("fluxwalk_command_" + std::to_string(getpid()));
        std::filesystem::create_directory(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    std::string write(const char* name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return path(name);
    }
    std::string read(const char* name) const {
        std::ifstream stream(folder_ / name, std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        return text.str();
    }
    std::size_t fileCount() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
    }

    static Result run(const std::vector<std::string>& args) {
        std::vector<const char*> argv = {"fluxwalk"};
        for (const std::string& arg : args) {
            argv.push_back(arg.c_str());
        }
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        Result result;
        result.code = runCommandLine(static_cast<int>(argv.size()), argv.data(), coreCommands());
        result.out = testing::internal::GetCapturedStdout();
        result.err = testing::internal::GetCapturedStderr();
        return result;
    }

    /// Runs what must fail with `code`, one line that holds `part`, no output and no new file.
    void expectFailure(const std::vector<std::string>& args, ExitCode code, const std::string& part) const {
        const std::size_t before = fileCount();
        const Result result = run(args);
        EXPECT_EQ(result.code, static_cast<int>(code)) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_TRUE(result.err.starts_with("fluxwalk: error: ")) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(fileCount(), before) << "nothing half-written";
    }

    std::filesystem::path folder_;
};

}  // namespace fluxwalk::cli
