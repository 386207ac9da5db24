#include "core/cli/progress.h"

#include <cstdio>
#include <memory>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace fluxwalk::cli {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string contentOf(std::FILE* file) {
    std::string text;
    std::rewind(file);
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
        text += static_cast<char>(c);
    }
    return text;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

TEST(Progress, DurationsReadNaturally) {
    EXPECT_EQ(formatDuration(0.04), "0.0 s");
    EXPECT_EQ(formatDuration(1.26), "1.3 s");
    EXPECT_EQ(formatDuration(9.96), "10 s");
    EXPECT_EQ(formatDuration(59.6), "1:00 min");
    EXPECT_EQ(formatDuration(200.0), "3:20 min");
    EXPECT_EQ(formatDuration(3723.0), "1:02:03 h");
}

TEST(Progress, TimeLeftFollowsThePace) {
    EXPECT_DOUBLE_EQ(estimateRemaining(0.25, 10.0), 30.0);
    EXPECT_DOUBLE_EQ(estimateRemaining(1.0, 10.0), 0.0);
    EXPECT_LT(estimateRemaining(0.0, 10.0), 0.0) << "unknown at the start";
    EXPECT_LT(estimateRemaining(0.5, 0.01), 0.0) << "unknown at the start";
}

TEST(Progress, BarFitsItsColumnsAndGrows) {
    const std::string half = formatBar(0.5, "refine", 2.0, 80);
    EXPECT_EQ(half, "[###############---------------]  50 %  refine  2.0 s, 2.0 s left");
    for (const unsigned columns : {0u, 10u, 30u, 50u, 200u}) {
        EXPECT_LE(formatBar(0.5, "refine", 2.0, columns).size(), columns);
    }
    EXPECT_EQ(formatBar(7.0, "done", 2.0, 80).find("100 %") == std::string::npos, false);
    EXPECT_NE(formatBar(-1.0, "start", 2.0, 80).find("  0 %"), std::string::npos);
}

TEST(Progress, LinesComeOnceASecond) {
    const File file(std::tmpfile(), std::fclose);
    ASSERT_TRUE(file);
    double now = 100.0;
    {
        Progress progress(file.get(), ProgressStyle::lines, [&] { return now; });
        for (int i = 0; i <= 50; ++i) {
            now = 100.0 + 0.1 * i;
            progress.update(i / 50.0, "refine");
        }
    }
    const std::vector<std::string> lines = linesOf(contentOf(file.get()));
    EXPECT_GE(lines.size(), 4u);
    EXPECT_LE(lines.size(), 5u);
    for (const std::string& line : lines) {
        EXPECT_NE(line.find(" %  refine"), std::string::npos) << line;
        EXPECT_EQ(line.find('\r'), std::string::npos);
        EXPECT_EQ(line.find('\033'), std::string::npos) << "no escapes where no terminal is";
    }
}

TEST(Progress, BarComesFiveTimesASecondAndLeavesNothing) {
    const File file(std::tmpfile(), std::fclose);
    ASSERT_TRUE(file);
    double now = 0.0;
    {
        Progress progress(file.get(), ProgressStyle::bar, [&] { return now; });
        for (int i = 0; i <= 1000; ++i) {
            now = 0.001 * i;
            progress.update(i / 1000.0, "refine");
        }
    }
    const std::string text = contentOf(file.get());
    const auto bars = static_cast<std::size_t>(std::count(text.begin(), text.end(), '['));
    // Each bar holds one bracket, and each bar and the end one escape with another.
    const std::size_t escapes = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\033'));
    EXPECT_GE(bars - escapes, 4u);
    EXPECT_LE(bars - escapes, 5u);
    EXPECT_TRUE(text.ends_with("\r\033[K"));
}

TEST(Progress, QuickWorkAndQuietWriteNothing) {
    const File file(std::tmpfile(), std::fclose);
    ASSERT_TRUE(file);
    double now = 0.0;
    {
        Progress quick(file.get(), ProgressStyle::lines, [&] { return now; });
        now = 0.5;
        quick.update(0.9, "refine");
        Progress quiet(file.get(), chooseStyle(file.get(), true), [&] { return now; });
        now = 50.0;
        quiet.update(0.9, "refine");
    }
    EXPECT_EQ(contentOf(file.get()), "");
}

TEST(Progress, FilesGetLines) {
    const File file(std::tmpfile(), std::fclose);
    ASSERT_TRUE(file);
    EXPECT_EQ(chooseStyle(file.get(), false), ProgressStyle::lines);
    EXPECT_EQ(chooseStyle(file.get(), true), ProgressStyle::none);
}

}  // namespace
}  // namespace fluxwalk::cli
