#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/probes.h"
#include "tests/support/solving.h"

// Check 26, refining only: going down step by step leads where going straight leads.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using test::Problem;

using EndName = std::tuple<hierarchy::NodeKind, std::uint32_t, std::uint32_t, bool, surface::Path>;
using LinkName = std::pair<EndName, EndName>;

EndName nameOf(const hierarchy::Hierarchy& h, NodeId id) {
    const hierarchy::ElementName name = h.name(id);
    return {h.kind(id), name.object, name.patch, name.back, name.path};
}

std::set<LinkName> linkNames(const Problem& problem) {
    std::set<LinkName> names;
    for (const hierarchy::Link& link : problem.links.links) {
        names.insert(std::minmax(nameOf(problem.hierarchy, link.a), nameOf(problem.hierarchy, link.b)));
    }
    return names;
}

std::unique_ptr<Problem> makeBox() {
    return test::makeProblem(*scene::buildScene("cornell-box-unit"));
}

constexpr double kThreshold = 1e-5;  // lux, the first; the mean is 1e-2

}  // namespace

TEST(Refinement, weightOfCurvatureLeavesPlanarScenesAlone) {
    const auto solve = [](double weight) {
        solve::Options options;
        options.curvatureWeight = weight;
        auto problem = test::makeProblem(*scene::buildScene("cornell-box-unit"), options);
        for (const double threshold : {kThreshold, .25 * kThreshold}) {
            test::refine(*problem, threshold);
            test::converge(*problem, 1e-3);
        }
        return problem;
    };
    const auto without = solve(0.0);
    const auto with = solve(8.0);
    EXPECT_EQ(linkNames(*without), linkNames(*with));
    for (const NodeId id : test::leavesOf(without->hierarchy)) {
        EXPECT_EQ(without->hierarchy.light(id).irradiance, with->hierarchy.light(id).irradiance);
    }
}

// Nothing is swept in between, so radiosities are those of the start.
TEST(Refinement, stepsLeadToTheSameLinks) {
    const auto light = [](Problem& problem) {
        for (const NodeId id : problem.hierarchy.patches()) {
            hierarchy::Light& l = problem.hierarchy.light(id);
            l.irradiance = Rgb(.01f);
            l.radiosity = l.emission + l.reflectance * l.irradiance;
        }
    };
    const auto stepwise = makeBox();
    const auto direct = makeBox();
    light(*stepwise);
    light(*direct);
    std::size_t last = 0;
    for (const double part : {1.0, .25, .0625}) {
        test::refine(*stepwise, part * kThreshold);
        EXPECT_GT(stepwise->links.links.size(), last);
        last = stepwise->links.links.size();
    }
    test::refine(*direct, .0625 * kThreshold);
    EXPECT_TRUE(linkNames(*stepwise) == linkNames(*direct));
    EXPECT_EQ(stepwise->hierarchy.leafCount(), direct->hierarchy.leafCount());
    // At rest nothing changes any more.
    EXPECT_FALSE(test::refine(*stepwise, .0625 * kThreshold));
}

TEST(Refinement, sweepsInBetweenCostNothing) {
    constexpr double kFirst = 4.0 * kThreshold;
    constexpr double kLast = .0625 * kFirst;
    const auto exact = makeBox();
    for (double threshold = kFirst; threshold >= kLast / 20.0; threshold /= 4.0) {
        test::refine(*exact, threshold);
        test::converge(*exact, 1e-4);
    }
    const std::vector<solve::Probe> probes = solve::drawProbes(*exact, 300, 5);
    const std::vector<Rgb> reference = solve::gatherProbes(*exact, probes);
    const auto errorOf = [&](Problem& problem) {
        test::converge(problem, 1e-5);
        problem.statistics.meanIrradiance = .01;
        return solve::relativeRms(solve::gatherProbes(problem, probes), reference);
    };
    const auto settle = [](Problem& problem) {
        // The radiosities that refinement reads are those that its links lead to.
        for (int round = 0; round < 3; ++round) {
            test::refine(problem, kLast);
            test::converge(problem, 1e-4);
        }
    };
    const auto stepwise = makeBox();
    for (const double part : {1.0, .25}) {
        test::refine(*stepwise, part * kFirst);
        test::converge(*stepwise, 1e-3);
    }
    settle(*stepwise);
    const auto direct = makeBox();
    settle(*direct);
    const auto links = static_cast<double>(direct->links.links.size());
    EXPECT_NEAR(static_cast<double>(stepwise->links.links.size()) / links, 1.0, .15);
    EXPECT_NEAR(errorOf(*stepwise) / errorOf(*direct), 1.0, .10);
}

}  // namespace fluxwalk
