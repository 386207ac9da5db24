#include "core/solve/budget.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/scene/builders.h"
#include "core/solve/assess_link.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// Budgets are kept, and spent where the errors are largest.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using solve::Budget;
using solve::Limit;
using solve::Options;
using solve::Outcome;
using solve::Solver;
using test::Problem;

Solver makeSolver(const Options& options, unsigned threads = 2) {
    return {std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box-unit")), options, threads};
}

Options withLinkLimit(std::uint64_t limit) {
    Options options;
    options.error = .001;
    options.linkLimit = limit;
    return options;
}

/// A box or a part of a building whose light does not change while it is refined.
std::unique_ptr<Problem> makeLit(const char* name) {
    auto problem = test::makeProblem(*scene::buildScene(name), test::withClusterLinks());
    for (const NodeId id : problem->hierarchy.patches()) {
        hierarchy::Light& light = problem->hierarchy.light(id);
        light.irradiance = Rgb(.01f);
        light.radiosity = light.emission + light.reflectance * light.irradiance;
    }
    return problem;
}

constexpr double kThreshold = 4e-5;  // lux, where the mean is 1e-2

std::string refusalOf(const Options& options) {
    try {
        Solver solver = makeSolver(options);
        solver.solve({});
    } catch (const base::UsageError& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST(Budget, linkLimitIsKeptAndUsed) {
    double error = 1e9;
    for (const std::uint64_t limit : {400u, 2000u, 10000u}) {
        Solver solver = makeSolver(withLinkLimit(limit));
        EXPECT_EQ(solver.solve({}), Outcome::reachedLinkLimit);
        const solve::Statistics& s = solver.statistics();
        EXPECT_LE(s.counters.links, limit);
        EXPECT_GT(s.counters.links, limit * 9 / 10);
        EXPECT_GT(s.largestError, s.threshold);
        // More links, less error.
        EXPECT_LT(s.estimatedError, error);
        EXPECT_GT(s.estimatedError, .001);
        error = s.estimatedError;
        EXPECT_NEAR(test::meanIrradiance(solver.problem(), 0).x / .009044, 1.0, .05) << limit;
        // Asked again, it stays where it is.
        const std::uint64_t links = s.counters.links;
        EXPECT_EQ(solver.solve({}), Outcome::reachedLinkLimit);
        EXPECT_LE(solver.statistics().counters.links, limit);
        EXPECT_GE(solver.statistics().counters.links, links);
    }
}

// The links that a budget leaves are those of the threshold that it reached.
TEST(Budget, largestErrorsAreRefinedFirst) {
    for (const char* name : {"cornell-box-unit", "two-rooms"}) {
        const auto limited = makeLit(name);
        test::refine(*limited, kThreshold);
        const std::uint64_t limit = 2 * limited->links.links.size();
        const solve::Refined refined =
            solve::refineLinks(*limited, kThreshold / 16.0, Budget(limit, 0, {}), {});
        EXPECT_EQ(refined.limit, Limit::links);
        EXPECT_GT(limited->links.links.size(), limit * 95 / 100);
        EXPECT_LE(limited->links.links.size(), limit);
        const double reached = limited->statistics.largestError;
        EXPECT_GT(reached, kThreshold / 16.0);
        EXPECT_LT(reached, kThreshold);
        for (const hierarchy::Link& link : limited->links.links) {
            const bool isOneOfClusters = limited->hierarchy.kind(link.a) == hierarchy::NodeKind::cluster ||
                                         limited->hierarchy.kind(link.b) == hierarchy::NodeKind::cluster;
            if (link.a != link.b && !isOneOfClusters) {
                ASSERT_LE(static_cast<double>(solve::assessLink(*limited, link, 0.0f).error), reached);
            }
        }
        const auto direct = makeLit(name);
        test::refine(*direct, reached);
        EXPECT_NEAR(static_cast<double>(direct->links.links.size()) /
                        static_cast<double>(limited->links.links.size()),
                    1.0, .1)
            << name;
    }
}

TEST(Budget, doesNotDependOnThreads) {
    Solver one = makeSolver(withLinkLimit(2500), 1);
    Solver three = makeSolver(withLinkLimit(2500), 3);
    one.solve({});
    three.solve({});
    EXPECT_EQ(one.statistics().counters.links, three.statistics().counters.links);
    EXPECT_EQ(one.statistics().largestError, three.statistics().largestError);
    EXPECT_EQ(one.statistics().meanIrradiance, three.statistics().meanIrradiance);
}

// A lower limit makes what stands coarser.
TEST(Budget, aLowerLimitTakesLinksBack) {
    Solver solver = makeSolver(withLinkLimit(8000));
    solver.solve({});
    const std::uint64_t before = solver.statistics().counters.nodes;
    solver.setOptions(withLinkLimit(1500));
    EXPECT_EQ(solver.solve({}), Outcome::reachedLinkLimit);
    EXPECT_LE(solver.statistics().counters.links, 1500u);
    EXPECT_LT(solver.statistics().counters.nodes, before);
    EXPECT_NEAR(test::meanIrradiance(solver.problem(), 0).x / .009044, 1.0, .05);
}

TEST(Budget, tooSmallForTheSceneIsNamed) {
    EXPECT_EQ(refusalOf(withLinkLimit(20)).find("--link-limit: 20 links are too few for this scene"), 0u);
    Options options;
    options.memoryLimit = 2 << 20;
    const std::string text = refusalOf(options);
    EXPECT_EQ(text.find("--memory-limit: 2 MiB is too little for this scene, which takes "), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

// What the process holds already counts, so the limit is set above it.
TEST(Budget, memoryLimitIsKept) {
    Options options;
    options.error = 1e-4;
    options.memoryLimit = base::residentMemory() + (48 << 20);
    Solver solver = makeSolver(options);
    EXPECT_EQ(solver.solve({}), Outcome::reachedMemoryLimit);
    const solve::Statistics& s = solver.statistics();
    EXPECT_LE(s.counters.bytesCounted, options.memoryLimit);
    EXPECT_GT(s.counters.bytesCounted, options.memoryLimit * 3 / 4);
    EXPECT_GT(s.counters.links, 10000u);
    EXPECT_GT(s.largestError, s.threshold);
}

TEST(Budget, footprintCountsWhatIsThere) {
    solve::Footprint f;
    f.base = 1000;
    f.builtNodes = 10;
    f.shownNodes = 10;
    const std::uint64_t built = f.bytes(10, 0);
    EXPECT_GE(built, 1000u);
    EXPECT_GE(f.bytes(11, 0), built + hierarchy::Hierarchy::bytesPerNode());
    EXPECT_GE(f.bytes(10, 1), built + sizeof(hierarchy::Link) + 2 * sizeof(std::uint32_t));
    const Budget budget(5, f.bytes(12, 5), f);
    EXPECT_TRUE(budget.holds(12, 5));
    EXPECT_EQ(budget.exceeded(12, 6), Limit::links);
    EXPECT_EQ(budget.exceeded(13, 5), Limit::memory);
    EXPECT_TRUE(Budget().holds(1u << 31, 1u << 31));
}

TEST(Memory, isTold) {
    const std::uint64_t before = base::residentMemory();
    EXPECT_GT(before, 1u << 20);
    EXPECT_GE(base::peakMemory(), before);
    EXPECT_GT(base::availableMemory(), 1u << 20);
    const std::vector<char> more(64 << 20, 1);
    EXPECT_GE(base::peakMemory(), before + (32 << 20)) << more.back();
}

}  // namespace fluxwalk
