#include "core/solve/preview.h"

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/display_update.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// What is shown on the way, and what is kept for the way back, changes no result.

namespace fluxwalk {

namespace {

using base::NodeId;
using solve::Options;
using solve::Snapshot;
using solve::Solver;

std::shared_ptr<const scene::Scene> cornellBox() {
    return std::make_shared<scene::Scene>(*scene::buildScene("cornell-box"));
}

void expectSameState(const solve::Problem& a, const solve::Problem& b) {
    ASSERT_EQ(a.hierarchy.nodeCount(), b.hierarchy.nodeCount());
    for (std::uint32_t i = 0; i < a.hierarchy.nodeCount(); ++i) {
        ASSERT_EQ(a.hierarchy.light(NodeId{i}).radiosity, b.hierarchy.light(NodeId{i}).radiosity);
        ASSERT_EQ(a.hierarchy.light(NodeId{i}).irradiance, b.hierarchy.light(NodeId{i}).irradiance);
    }
    ASSERT_EQ(a.links.links.size(), b.links.links.size());
    for (std::size_t i = 0; i < a.links.links.size(); ++i) {
        ASSERT_EQ(a.links.links[i].a, b.links.links[i].a);
        ASSERT_EQ(a.links.links[i].b, b.links.links[i].b);
        ASSERT_EQ(a.links.links[i].coupling, b.links.links[i].coupling);
        // What is certain may have been told by another ancestor's shaft; what is seen is the same.
        ASSERT_EQ(a.links.links[i].visibility(), b.links.links[i].visibility());
    }
}

}  // namespace

TEST(Preview, picturesOnTheWayChangeNoBit) {
    Options options;
    options.error = 0.1;
    Solver quiet(cornellBox(), options, 2);
    quiet.solve({});

    Solver shown(cornellBox(), options, 2);
    std::vector<std::shared_ptr<const Snapshot>> snapshots;
    solve::Callbacks callbacks;
    callbacks.publish = [&](std::shared_ptr<const Snapshot> s) { snapshots.push_back(std::move(s)); };
    shown.solve(callbacks);
    expectSameState(quiet.problem(), shown.problem());

    // The first one is the first guess: everything is lit, and by no link.
    ASSERT_GE(snapshots.size(), 2u);
    const Snapshot& first = *snapshots.front();
    EXPECT_EQ(first.statistics.counters.links, 0u);
    EXPECT_GT(first.statistics.meanIrradiance, 0.1 * shown.statistics().meanIrradiance);
    EXPECT_LT(first.statistics.meanIrradiance, 10.0 * shown.statistics().meanIrradiance);
    for (const auto& mesh : first.meshes) {
        for (const base::Rgb& e : mesh->irradiance) {
            ASSERT_GT(e.g, 0.0f);
        }
    }
}

TEST(Preview, knownPairsAreNotComputedAgain) {
    Options fine;
    fine.error = 0.2;
    fine.threshold = 1e-3;
    Options coarse = fine;
    coarse.threshold = 8.0 * fine.threshold;
    const auto solveTwice = [&](const solve::Callbacks& callbacks) {
        auto solver = std::make_unique<Solver>(cornellBox(), fine, 2);
        solver->solve(callbacks);
        const std::uint64_t before = solver->statistics().counters.kernelEvaluations;
        const std::uint64_t links = solver->statistics().counters.links;
        solver->setOptions(coarse);
        solver->solve(callbacks);
        EXPECT_LT(solver->statistics().counters.links, links);
        return std::pair(std::move(solver), before);
    };
    const auto [forgetful, some] = solveTwice({});
    solve::Callbacks tuned;
    tuned.newOptions = [] { return std::optional<Options>(); };
    const auto [knowing, all] = solveTwice(tuned);
    EXPECT_EQ(some, all);
    // Other light may open other ends of some pairs: these are new.
    const std::uint64_t again = forgetful->statistics().counters.kernelEvaluations - some;
    EXPECT_GT(again, 0u);
    EXPECT_LT(knowing->statistics().counters.kernelEvaluations - all, again / 10);
    expectSameState(forgetful->problem(), knowing->problem());
}

TEST(Preview, whereThereIsNoTimeObjectsStayAsTheyWereShown) {
    auto problem = test::makeProblem(scene::buildGallery());
    solve::DisplayUpdate display(*problem);
    const scene::LitMeshes before = display.refresh();
    problem->options.displayAngle = 12.0;
    EXPECT_FALSE(display.refreshUntil({}));
    EXPECT_EQ(display.meshes(), before);
    const scene::LitMeshes after = display.refresh();
    EXPECT_TRUE(display.refreshUntil(std::chrono::steady_clock::time_point::max()));
    EXPECT_EQ(display.meshes(), after);
    EXPECT_NE(before, after);
}

}  // namespace fluxwalk
