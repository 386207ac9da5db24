#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/audit.h"
#include "core/solve/row_scaling.h"
#include "tests/support/solving.h"

// Check 24 in closed scenes: what the lights emit is absorbed, to 1e-4 once the sweeps have converged.

namespace fluxwalk {

namespace {

using test::Problem;

double defectOf(Problem& problem) {
    test::converge(problem, 1e-9);
    const solve::Audit audit = solve::auditEnergy(problem, 1000);
    EXPECT_TRUE(audit.isClosed);
    EXPECT_EQ(audit.escaped, base::Vec3d(0.0));
    EXPECT_GT(audit.emitted.y, 0.0);
    return audit.relativeDefect();
}

}  // namespace

// Rows of direct links only, as in check 7, unscaled.
TEST(Balance, closedFurnace) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        solve::Options options;
        options.clusterLinks = solve::ClusterLinks::off;
        options.minArea = .004;
        options.seed = seed;
        const auto problem = test::makeProblem(scene::buildFurnace(.5f, false), options);
        test::refine(*problem, 1e-9);
        EXPECT_LE(defectOf(*problem), 1e-4) << seed;
    }
}

TEST(Balance, emptyCube) {
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;
    options.minArea = .2;
    const auto problem = test::makeProblem(scene::buildCie58(.5f), options);
    test::refine(*problem, 1e-9);
    EXPECT_LE(defectOf(*problem), 1e-4);
}

// Light that is lost on the way shows in the audit, as it is no remainder.
TEST(Balance, showsWhatIsMissing) {
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;
    options.minArea = .2;
    const auto problem = test::makeProblem(scene::buildCie58(.5f), options);
    test::refine(*problem, 1e-9);
    for (hierarchy::Link& link : problem->links.links) {
        link.coupling *= problem->hierarchy.kind(link.b) == hierarchy::NodeKind::element ? .98f : 1.0f;
    }
    EXPECT_NEAR(defectOf(*problem), .02, .002);
}

// Before it has converged, the balance is open by what still travels.
TEST(Balance, showsWhatStillTravels) {
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;
    options.minArea = .2;
    const auto problem = test::makeProblem(scene::buildCie58(.9f), options);
    test::refine(*problem, 1e-9);
    solve::Sweeper(*problem).sweep();
    EXPECT_GT(solve::auditEnergy(*problem, 1000).relativeDefect(), .1);
}

// The audit's row sums are those of what is transported, at all levels of links.
TEST(Balance, rowSumsAreTransported) {
    const auto problem = test::makeProblem(*scene::buildScene("furnace"));
    test::refine(*problem, 3e-5);
    const std::vector<double> transported = test::transportedRowSums(*problem);
    const std::vector<float> sums = solve::computeRowSums(*problem, {});
    std::size_t inherited = 0;
    for (const base::NodeId id : test::leavesOf(problem->hierarchy)) {
        EXPECT_NEAR(static_cast<double>(sums[base::index(id)]), transported[base::index(id)], 1e-5);
        inherited += problem->links.endingAt(problem->hierarchy.parent(id)).empty() ? 0u : 1u;
    }
    EXPECT_GT(inherited, 100u);
}

// Factors that sum to half as much again, as where surfaces lie closer upon each other than rays can tell:
// walls that reflect .8 would send on 1.2 times what they got, and light would grow without end.
TEST(Balance, rowsFarAboveOneDoNotFeedThemselves) {
    solve::Options options;
    options.clusterLinks = solve::ClusterLinks::off;
    options.minArea = .2;
    const auto problem = test::makeProblem(scene::buildCie58(.8f), options);
    test::refine(*problem, 1e-9);
    EXPECT_TRUE(solve::limitRows(*problem).empty());
    const auto ends = [&](const hierarchy::Link& link) {
        return problem->hierarchy.kind(link.b) == hierarchy::NodeKind::element;
    };
    for (hierarchy::Link& link : problem->links.links) {
        link.coupling *= ends(link) ? 1.5f : 1.0f;
    }
    const std::vector<float> kept = solve::limitRows(*problem);
    const std::vector<float> sums = solve::computeRowSums(*problem, {});
    ASSERT_EQ(kept.size(), problem->hierarchy.nodeCount());
    for (const base::NodeId id : test::leavesOf(problem->hierarchy)) {
        EXPECT_NEAR(kept[base::index(id)] * sums[base::index(id)], .98f / .8f, 1e-5f);
    }
    EXPECT_LT(test::converge(*problem, 1e-4), 1000);
    double largest = 0.0;
    for (const base::NodeId id : test::leavesOf(problem->hierarchy)) {
        largest = std::max(largest, static_cast<double>(problem->hierarchy.light(id).radiosity.g));
    }
    EXPECT_LT(largest, 1e6);
}

}  // namespace fluxwalk
