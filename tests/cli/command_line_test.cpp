#include <memory>
#include <new>
#include <sstream>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/cli/command.h"
#include "core/cli/output.h"
#include "core/cli/scene_arguments.h"
#include "core/cli/solver_arguments.h"

namespace fluxwalk::cli {
namespace {

/// What a run printed and returned.
struct Result {
    int code = -1;
    std::string out;
    std::string err;
};

/// What the last command saw.
struct Seen {
    std::string command;
    SceneArguments scene;
    SolverArguments solver;
};

/// Two commands with the program's own options that note what they were given, and one that fails as asked.
std::vector<Command> makeCommands(Seen& seen) {
    const auto noting = [&seen](const char* name) {
        return Command{name, "Notes its arguments.", [&seen, name](CLI::App& app) {
                           const auto scene = std::make_shared<SceneArguments>();
                           const auto solver = std::make_shared<SolverArguments>();
                           addSceneOptions(app, *scene);
                           addSolverOptions(app, *solver);
                           return [&seen, name, scene, solver] {
                               seen = {name, *scene, *solver};
                               return ExitCode::success;
                           };
                       }};
    };
    const Command failing{"fail", "Fails.", [](CLI::App& app) {
                              const auto how = std::make_shared<std::string>();
                              app.add_option("HOW", *how)->required();
                              return [how]() -> ExitCode {
                                  if (*how == "read") {
                                      throw base::FileError("a.glb", "/nodes/3", "is its own parent");
                                  }
                                  if (*how == "write") {
                                      throw WriteError("b.glb", "", "cannot be written");
                                  }
                                  if (*how == "memory") {
                                      throw std::bad_alloc();
                                  }
                                  if (*how == "stop") {
                                      return ExitCode::interrupted;
                                  }
                                  throw std::logic_error("surprise");
                              };
                          }};
    return {noting("view"), noting("solve"), failing};
}

class CommandLine : public testing::Test {
  protected:
    Result run(std::vector<const char*> args) {
        args.insert(args.begin(), "fluxwalk");
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        Result result;
        result.code = runCommandLine(static_cast<int>(args.size()), args.data(), makeCommands(seen_));
        result.out = testing::internal::GetCapturedStdout();
        result.err = testing::internal::GetCapturedStderr();
        return result;
    }

    /// Runs what must be refused as misuse, and returns the one line that says why.
    std::string refusal(const std::vector<const char*>& args) {
        const Result result = run(args);
        EXPECT_EQ(result.code, 2) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(seen_.command, "") << "nothing was run";
        const std::string start = "fluxwalk: error: ";
        EXPECT_TRUE(result.err.starts_with(start)) << result.err;
        return result.err.substr(start.size(), result.err.size() - start.size() - 1);
    }

    Seen seen_;
};

TEST_F(CommandLine, RunsTheNamedCommandWithItsArguments) {
    const Result result = run({"solve", "room.glb", "--error", "5%", "--oracle", "bf", "--threads", "3",
                               "--sky", "200", "--row-scaling", "--seed=7"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(seen_.command, "solve");
    EXPECT_EQ(seen_.scene.scene, "room.glb");
    EXPECT_EQ(seen_.scene.sky, 200.0);
    EXPECT_DOUBLE_EQ(seen_.solver.options.error, 0.05);
    EXPECT_EQ(seen_.solver.options.oracle, solve::OracleKind::bf);
    EXPECT_EQ(seen_.solver.options.seed, 7u);
    EXPECT_TRUE(seen_.solver.options.rowScaling);
    EXPECT_EQ(seen_.solver.threads, 3u);
}

TEST_F(CommandLine, DefaultsAreKeptWhereNothingIsSaid) {
    EXPECT_EQ(run({"solve", "room.glb"}).code, 0);
    EXPECT_EQ(seen_.solver.options.error, solve::Options{}.error);
    EXPECT_FALSE(seen_.solver.options.rowScaling);
    EXPECT_EQ(seen_.solver.threads, 0u);
    EXPECT_LT(seen_.scene.sky, 0.0);
}

TEST_F(CommandLine, FirstCommandIsMeantWhereNoneIsNamed) {
    EXPECT_EQ(run({"room.glb"}).code, 0);
    EXPECT_EQ(seen_.command, "view");
    EXPECT_EQ(run({"--error", "10%", "room.glb"}).code, 0);
    EXPECT_DOUBLE_EQ(seen_.solver.options.error, 0.1);
    EXPECT_EQ(run({"cornell-box"}).code, 0);
    EXPECT_EQ(seen_.scene.scene, "cornell-box");
    EXPECT_EQ(run({"view", "solve"}).code, 0) << "after a command, a command's name is a scene";
    EXPECT_EQ(seen_.scene.scene, "solve");
}

TEST_F(CommandLine, UnknownOptionsSuggestTheNearest) {
    EXPECT_EQ(refusal({"solve", "room.glb", "--eror", "5%"}),
              "unknown option '--eror'; did you mean '--error'?");
    EXPECT_EQ(refusal({"solve", "room.glb", "--eror=5%"}),
              "unknown option '--eror'; did you mean '--error'?");
    EXPECT_EQ(refusal({"solve", "--treshold", "1", "room.glb"}),
              "unknown option '--treshold'; did you mean '--threshold'?");
    EXPECT_EQ(refusal({"solve", "--eror"}), "unknown option '--eror'; did you mean '--error'?")
        << "rather than that the scene is missing";
    EXPECT_EQ(refusal({"room.glb", "--wireframe"}), "unknown option '--wireframe'");
}

TEST_F(CommandLine, UnknownCommandsSuggestTheNearest) {
    EXPECT_EQ(refusal({"slove", "room.glb"}), "unknown command 'slove'; did you mean 'solve'?");
}

TEST_F(CommandLine, MisuseIsNamed) {
    EXPECT_NE(refusal({"solve"}).find("SCENE"), std::string::npos);
    EXPECT_EQ(refusal({"solve", "a.glb", "b.glb"}), "unexpected 'b.glb' after the arguments of solve");
    EXPECT_EQ(refusal({"solve", "a.glb", "--error", "2"}),
              "--error: '2' is not 0.01 % to 100 %; did you mean 2%?");
    EXPECT_EQ(refusal({"solve", "a.glb", "--sky", "-5"}), "--sky: '-5' is not 0 to 1e+06 lux");
    EXPECT_EQ(refusal({"solve", "a.glb", "--threads", "many"}),
              "--threads: 'many' is not a whole number from 0 to 1024");
    EXPECT_NE(refusal({"solve", "a.glb", "--error"}).find("--error"), std::string::npos);
}

TEST_F(CommandLine, ErrorsHaveTheirCodesAndOneLine) {
    const Result read = run({"fail", "read"});
    EXPECT_EQ(read.code, 3);
    EXPECT_EQ(read.err, "fluxwalk: error: a.glb: /nodes/3: is its own parent\n");
    EXPECT_EQ(run({"fail", "write"}).code, 4);
    EXPECT_EQ(run({"fail", "memory"}).code, 1);
    EXPECT_EQ(run({"fail", "memory"}).err, "fluxwalk: error: out of memory\n");
    EXPECT_EQ(run({"fail", "otherwise"}).err, "fluxwalk: error: surprise\n");
    EXPECT_EQ(run({"fail", "stop"}).code, 130);
}

TEST_F(CommandLine, HelpNamesCommandsAndExitCodes) {
    for (const std::vector<const char*>& args :
         {std::vector<const char*>{"--help"}, std::vector<const char*>{"-h"}, std::vector<const char*>{}}) {
        const Result result = run(args);
        EXPECT_EQ(result.code, 0);
        EXPECT_EQ(result.err, "");
        for (const char* part : {"view", "solve", "Exit codes:", "130", "--version", "Without a command"}) {
            EXPECT_NE(result.out.find(part), std::string::npos) << part;
        }
    }
}

TEST_F(CommandLine, HelpAfterACommandIsTheCommands) {
    for (const std::vector<const char*>& args :
         {std::vector<const char*>{"solve", "--help"}, std::vector<const char*>{"solve", "room.glb", "-h"}}) {
        const Result result = run(args);
        EXPECT_EQ(result.code, 0);
        EXPECT_NE(result.out.find("--oracle"), std::string::npos);
        EXPECT_EQ(result.out.find("Exit codes:"), std::string::npos);
        EXPECT_EQ(seen_.command, "");
    }
}

TEST_F(CommandLine, VersionIsPrinted) {
    const Result result = run({"--version"});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out.find("fluxwalk "), 0u);
}

}  // namespace
}  // namespace fluxwalk::cli
