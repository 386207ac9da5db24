#include "core/solve/turn.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// Options that are turned while a solution stands: what it has is kept as far as they allow.

namespace fluxwalk {
namespace {

using solve::Options;
using solve::Outcome;
using solve::Solver;
using solve::Turn;

Options withError(double error) {
    Options options;
    options.error = error;
    return options;
}

Solver makeSolver(const Options& options, const char* name = "cornell-box") {
    return {std::make_shared<const scene::Scene>(*scene::buildScene(name)), options, 2};
}

double linksOf(const Solver& solver) {
    return static_cast<double>(solver.statistics().counters.links);
}

TEST(Turn, comparesOptions) {
    const std::vector<solve::HistoryEntry> history{{.threshold = 4.0, .error = 0.3},
                                                   {.threshold = 1.0, .error = 0.1},
                                                   {.threshold = 0.25, .error = 0.02}};
    const Options fine = withError(0.02);
    const auto turnOf = [&](const Options& after) { return compareOptions(fine, after, history).turn; };
    EXPECT_EQ(turnOf(fine), Turn::none);
    EXPECT_EQ(turnOf(withError(0.01)), Turn::none);
    EXPECT_EQ(turnOf(withError(0.12)), Turn::coarser);
    EXPECT_EQ(compareOptions(fine, withError(0.12), history).threshold, 1.0);
    EXPECT_EQ(compareOptions(fine, withError(0.9), history).threshold, 4.0);
    Options after = fine;
    after.curvatureWeight = 2.0;
    EXPECT_EQ(turnOf(after), Turn::finer);
    after.curvatureWeight = 0.0;
    EXPECT_EQ(turnOf(after), Turn::coarser);
    after = fine;
    after.minArea = 1.0;
    EXPECT_EQ(turnOf(after), Turn::coarser);
    after.oracle = solve::OracleKind::bfa;
    EXPECT_EQ(turnOf(after), Turn::anew);
    after = fine;
    after.displayAngle = 1.0;
    after.pullRule = solve::PullRule::projected;
    after.timeLimit = 3.0;
    EXPECT_EQ(turnOf(after), Turn::none);
    EXPECT_FALSE(needsNewSolver(fine, after));
    after.seed = 7;
    EXPECT_TRUE(needsNewSolver(fine, after));
}

// Levels of before a raise say nothing of what it leads to.
TEST(Turn, onlyTheLastDescentCounts) {
    const std::vector<solve::HistoryEntry> history{{.threshold = 9.0, .error = 0.01},
                                                   {.threshold = 0.1, .error = 0.01},
                                                   {.threshold = 2.0, .error = 0.2},
                                                   {.threshold = 0.5, .error = 0.05}};
    EXPECT_EQ(compareOptions(withError(0.01), withError(0.1), history).threshold, 0.5);
}

TEST(Turn, aRaisedErrorTargetTakesLinksBack) {
    Solver solver = makeSolver(withError(0.02));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const double fine = linksOf(solver);
    Solver fresh = makeSolver(withError(0.1));
    ASSERT_EQ(fresh.solve({}), Outcome::reachedError);
    ASSERT_LT(linksOf(fresh), 0.5 * fine);
    solver.setOptions(withError(0.1));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_LE(solver.statistics().estimatedError, 0.1);
    EXPECT_NEAR(linksOf(solver) / linksOf(fresh), 1.0, 0.2);
    // Asked once, done once.
    const double coarse = linksOf(solver);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_EQ(linksOf(solver), coarse);
    // And back.
    solver.setOptions(withError(0.02));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_LE(solver.statistics().estimatedError, 0.02);
    EXPECT_NEAR(linksOf(solver) / fine, 1.0, 0.2);
}

TEST(Turn, smallestElementsGoAndComeBack) {
    Options options = withError(0.05);
    Solver solver = makeSolver(options);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const std::uint64_t leaves = solver.statistics().counters.leaves;
    const double threshold = solver.statistics().threshold;
    options.threshold = threshold;
    options.minArea = 0.01 * solver.problem().hierarchy.totalArea();
    solver.setOptions(options);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_LT(solver.statistics().counters.leaves, leaves / 2);
    EXPECT_EQ(solver.statistics().threshold, threshold);
    options.minArea = 0.0;
    solver.setOptions(options);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_NEAR(static_cast<double>(solver.statistics().counters.leaves), static_cast<double>(leaves),
                0.15 * static_cast<double>(leaves));
}

TEST(Turn, anotherOracleBeginsAnewWithTheLightThatStands) {
    Options options = withError(0.1);
    Solver solver = makeSolver(options);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const double mean = solver.statistics().meanIrradiance;
    options.oracle = solve::OracleKind::bf;
    double least = mean;
    solve::Callbacks callbacks;
    callbacks.settled = [&] { least = std::min(least, solver.statistics().meanIrradiance); };
    solver.setOptions(options);
    ASSERT_EQ(solver.solve(callbacks), Outcome::reachedError);
    EXPECT_GT(least, 0.5 * mean);
    EXPECT_LE(solver.statistics().estimatedError, 0.1);
    Solver fresh = makeSolver(options);
    ASSERT_EQ(fresh.solve({}), Outcome::reachedError);
    EXPECT_NEAR(linksOf(solver) / linksOf(fresh), 1.0, 0.5);
    EXPECT_NEAR(solver.statistics().meanIrradiance, fresh.statistics().meanIrradiance, 0.02 * mean);
}

TEST(Turn, pullRuleAndRowScalingAreTakenBack) {
    Options options = withError(0.2);
    Solver solver = makeSolver(options, "blobs");
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    const double mean = solver.statistics().meanIrradiance;
    const double defect = std::abs(solver.statistics().audit.pullDefect);
    const double links = linksOf(solver);
    options.pullRule = solve::PullRule::projected;
    options.rowScaling = true;
    solver.setOptions(options);
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_GT(std::abs(solver.statistics().audit.pullDefect), 10.0 * defect);
    EXPECT_FALSE(solver.problem().rowScale.empty());
    EXPECT_NE(solver.statistics().meanIrradiance, mean);
    solver.setOptions(withError(0.2));
    ASSERT_EQ(solver.solve({}), Outcome::reachedError);
    EXPECT_NEAR(solver.statistics().meanIrradiance, mean, 1e-5 * mean);
    EXPECT_EQ(linksOf(solver), links);
}

}  // namespace
}  // namespace fluxwalk
