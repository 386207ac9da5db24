#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "core/cli/help_formatter.h"
#include "core/cli/solver_arguments.h"
#include "core/solve/options_table.h"

namespace fluxwalk::cli {
namespace {

TEST(Help, TextWrapsAtSpaces) {
    EXPECT_EQ(wrapText("one two three", 7), (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(wrapText("one two three", 100), (std::vector<std::string>{"one two three"}));
    EXPECT_EQ(wrapText("incomprehensibilities are long", 5),
              (std::vector<std::string>{"incomprehensibilities", "are", "long"}));
    EXPECT_TRUE(wrapText("", 5).empty());
}

TEST(Help, TeachesEveryOptionWithUnitDefaultAndRange) {
    CLI::App app;
    app.formatter(std::make_shared<HelpFormatter>());
    SolverArguments arguments;
    addSolverOptions(app, arguments);
    std::string help;
    std::istringstream stream(app.help());
    for (std::string line; std::getline(stream, line);) {
        EXPECT_LE(line.size(), 100u) << line;
        // Joined again, so that wrapping does not hide a phrase.
        help += line.substr(std::min(line.find_first_not_of(' '), line.size())) + " ";
    }
    for (const solve::OptionInfo& option : solve::optionsTable()) {
        EXPECT_NE(help.find("--" + std::string(option.name)), std::string::npos) << option.name;
        EXPECT_NE(help.find(option.explanation), std::string::npos) << option.name;
        EXPECT_NE(help.find(solve::describeRange(option)), std::string::npos) << option.name;
        if (option.kind != solve::OptionKind::flag) {
            EXPECT_NE(help.find("Default " + solve::formatOption(option, option.defaultValue())),
                      std::string::npos)
                << option.name;
        }
    }
    EXPECT_NE(help.find("--threshold LUX"), std::string::npos);
    EXPECT_NE(help.find("Solver:"), std::string::npos) << "options are grouped";
}

}  // namespace
}  // namespace fluxwalk::cli
