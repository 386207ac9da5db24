#include <cmath>

#include <gtest/gtest.h>

#include "tests/bench/cost.h"
#include "tests/bench/growth_plot.h"

namespace fluxwalk::bench {
namespace {

TEST(Growth, ExponentOfAPower) {
    PlotLine line{"", {10, 30, 100, 1000}, {}};
    for (const double x : line.x) {
        line.y.push_back(7.0 * std::pow(x, 1.25));
    }
    EXPECT_NEAR(fitExponent(line), 1.25, 1e-12);
    EXPECT_TRUE(std::isnan(fitExponent({"", {10}, {1}})));
    EXPECT_TRUE(std::isnan(fitExponent({"", {10, 10}, {1, 2}})));
}

TEST(Growth, PlotsShowEveryPoint) {
    const Plot plot{"links", "polygons", "links", {{"rooms", {1e4, 1e5}, {3e3, 4e4}}, {"none", {}, {}}}};
    const std::string svg = drawPlots({plot, {"empty", "x", "y", {}}});
    std::size_t points = 0;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
        ++points;
    }
    EXPECT_EQ(points, 2u);
    EXPECT_NE(svg.find("rooms, n^1.12"), std::string::npos) << svg;
    EXPECT_NE(svg.find(">10 k<"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

Level levelAt(double error, double seconds, std::uint64_t links) {
    Level level;
    level.errors.gathered.rms = error;
    level.duration.seconds = seconds;
    level.statistics.counters.links = links;
    return level;
}

// Between levels costs follow a power of the error.
TEST(Growth, CostWhereTheErrorPasses) {
    const std::vector<Level> levels{levelAt(0.4, 1.0, 100), levelAt(0.1, 4.0, 1600), levelAt(0.05, 9.0, 1e4)};
    const Cost cost = costAt(levels, {solve::ErrorOf::gathered, 0.2});
    ASSERT_TRUE(cost.isReached);
    EXPECT_NEAR(cost.seconds, 2.0, 1e-9);
    EXPECT_NEAR(cost.links, 400.0, 1e-6);
    EXPECT_NEAR(costAt(levels, {solve::ErrorOf::gathered, 0.4}).seconds, 1.0, 1e-12);
    EXPECT_FALSE(costAt(levels, {solve::ErrorOf::gathered, 0.01}).isReached);
}

}  // namespace
}  // namespace fluxwalk::bench
