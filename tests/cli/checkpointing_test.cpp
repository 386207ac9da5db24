#include "core/cli/checkpointing.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/cli/command.h"
#include "core/scene/builders.h"

// --checkpoint and --resume as they are typed, and a disk that is full.
namespace fluxwalk::cli {
namespace {

namespace fs = std::filesystem;

class Checkpoints : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("fluxwalk_checkpoints_" + std::to_string(getpid()));
        fs::create_directory(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    std::string read(const char* name) const {
        std::ifstream stream(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// Exit code and what went to standard error.
    static std::pair<int, std::string> run(std::vector<std::string> args) {
        args.insert(args.begin(), "fluxwalk");
        std::vector<const char*> argv;
        for (const std::string& arg : args) {
            argv.push_back(arg.c_str());
        }
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = runCommandLine(static_cast<int>(argv.size()), argv.data(), coreCommands());
        testing::internal::GetCapturedStdout();
        return {code, testing::internal::GetCapturedStderr()};
    }
    std::pair<int, std::string> solve(const char* lit, std::vector<std::string> more) const {
        more.insert(more.begin(), {"solve", "cornell-box", "--quiet", "-o", path(lit)});
        return run(std::move(more));
    }

    fs::path folder_;
};

TEST_F(Checkpoints, ResumedOutputHasTheSameBytes) {
    ASSERT_EQ(solve("a.glb", {"--error", "10%", "--checkpoint", path("a.fwc")}).first, 0);
    // With the checkpoint's own error; the file that is resumed may be the one that is kept.
    const std::string kept = read("a.fwc");
    ASSERT_EQ(solve("b.glb", {"--resume", path("a.fwc"), "--checkpoint", path("a.fwc")}).first, 0);
    EXPECT_EQ(read("a.glb"), read("b.glb"));
    EXPECT_EQ(read("a.fwc"), kept);
    // Nothing is left to solve, and still there is something to keep.
    ASSERT_EQ(solve("b.glb", {"--resume", path("a.fwc"), "--checkpoint", path("b.fwc")}).first, 0);
    EXPECT_TRUE(fs::exists(path("b.fwc")));
    // Measured by another command.
    std::ofstream(folder_ / "in.csv") << "x,y,z,nx,ny,nz\n0.2,0,0.2,0,1,0\n";
    EXPECT_EQ(run({"measure", "cornell-box", "--quiet", "--sensors", path("in.csv"), "-o", path("out.csv"),
                   "--resume", path("b.fwc")})
                  .first,
              0);
}

TEST_F(Checkpoints, WhatIsTypedGoesFirst) {
    ASSERT_EQ(solve("a.glb", {"--error", "40%", "--seed", "3", "--checkpoint", path("a.fwc")}).first, 0);
    SolverArguments arguments;
    arguments.resume = path("a.fwc");
    EXPECT_EQ(Checkpointing(arguments).options().error, .4);
    EXPECT_EQ(Checkpointing(arguments).options().seed, 3u);
    arguments.typed.emplace_back(solve::findOption("error"), .3);
    EXPECT_EQ(Checkpointing(arguments).options().error, .3);
}

TEST_F(Checkpoints, BadOnesAreRefusedAndStayAsTheyAre) {
    ASSERT_EQ(solve("a.glb", {"--error", "40%", "--checkpoint", path("a.fwc")}).first, 0);
    const std::string whole = read("a.fwc");
    const auto expectRefusal = [this](const std::vector<std::string>& more, const char* part) {
        const auto [code, err] = solve("b.glb", more);
        EXPECT_NE(err.find(part), std::string::npos) << err;
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        EXPECT_EQ(code, static_cast<int>(ExitCode::badInput));
        EXPECT_FALSE(fs::exists(path("b.glb")));
    };
    expectRefusal({"--resume", path("none.fwc")}, "none.fwc: no such file");
    expectRefusal({"--resume", path("a.glb")}, "a.glb: is no checkpoint");
    expectRefusal({"--resume", path("a.fwc"), "--sky", "5"}, "a.fwc: belongs to another scene");
    expectRefusal({"--resume", path("a.fwc"), "--seed", "2"}, "a.fwc: was solved with another --seed");
    std::string altered = whole;
    altered[altered.size() / 2] ^= 1;
    std::ofstream(folder_ / "a.fwc", std::ios::binary) << altered;
    expectRefusal({"--resume", path("a.fwc"), "--checkpoint", path("a.fwc")}, "a.fwc: is damaged");
    EXPECT_EQ(read("a.fwc"), altered);
    std::ofstream(folder_ / "a.fwc", std::ios::binary) << whole.substr(0, 3000);
    expectRefusal({"--resume", path("a.fwc")}, "a.fwc: has 3000 bytes");
}

TEST_F(Checkpoints, WhereNoneCanBeKeptIsSaidBeforeTheWork) {
    const auto [code, err] = solve("a.glb", {"--checkpoint", path("missing") + "/a.fwc"});
    EXPECT_EQ(code, static_cast<int>(ExitCode::cannotWrite));
    EXPECT_NE(err.find("a.fwc: cannot be written"), std::string::npos) << err;
}

// Before the first wave, and still the result is that of a solve without a stop.
TEST_F(Checkpoints, AStopInTheFirstLevelIsKept) {
    const auto [code, err] =
        solve("a.glb", {"--error", "10%", "--time-limit", "0.000001", "--checkpoint", path("a.fwc")});
    EXPECT_EQ(code, 0);
    EXPECT_EQ(err, "");
    ASSERT_EQ(solve("b.glb", {"--resume", path("a.fwc")}).first, 0);
    ASSERT_EQ(solve("c.glb", {"--error", "10%"}).first, 0);
    EXPECT_EQ(read("b.glb"), read("c.glb"));
    EXPECT_NE(read("a.glb"), read("c.glb"));
}

// With no time in between, one is kept after every wave; the last is that of the last level.
TEST_F(Checkpoints, IntervalsAreKeptWithinLevels) {
    ASSERT_EQ(
        solve("a.glb", {"--error", "20%", "--checkpoint", path("a.fwc"), "--checkpoint-interval", "0"}).first,
        0);
    ASSERT_EQ(solve("b.glb", {"--error", "20%", "--checkpoint", path("b.fwc")}).first, 0);
    EXPECT_EQ(read("a.glb"), read("b.glb"));
    EXPECT_EQ(solve("a.glb", {"--checkpoint-interval", "-1"}).first, static_cast<int>(ExitCode::usage));
}

// A file that cannot grow further stands for a full disk.
TEST_F(Checkpoints, AFullDiskIsAWarningAndTheSolveGoesOn) {
    SolverArguments arguments;
    arguments.checkpoint = path("a.fwc");
    arguments.options.error = .1;
    Checkpointing checkpointing(arguments);
    const auto solver = checkpointing.makeSolver(
        std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box")), arguments.options, 2);
    std::string first;
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    testing::internal::CaptureStderr();
    solve::Callbacks callbacks;
    callbacks.resumable = [&](solve::Moment moment) {
        if (moment != solve::Moment::level) {
            return;
        }
        checkpointing.keep(*solver, moment);
        if (first.empty()) {
            first = read("a.fwc");
            rlimit tight = before;
            tight.rlim_cur = 16384;
            setrlimit(RLIMIT_FSIZE, &tight);
        }
    };
    const solve::Outcome outcome = solver->solve(callbacks);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    const std::string err = testing::internal::GetCapturedStderr();
    EXPECT_EQ(outcome, solve::Outcome::reachedError);
    EXPECT_GT(solver->statistics().history.size(), 1u);
    EXPECT_NE(err.find("warning: the checkpoint was not kept: " + path("a.fwc")), std::string::npos) << err;
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(read("a.fwc"), first);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

}  // namespace
}  // namespace fluxwalk::cli
