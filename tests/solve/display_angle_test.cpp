#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"

// The displayed roundness of curved surfaces moves without solving anew.

namespace fluxwalk {
namespace {

std::size_t triangleCount(const solve::Solver& solver) {
    std::size_t count = 0;
    for (const auto& mesh : solver.litMeshes()) {
        count += mesh->triangles.size() / 3;
    }
    return count;
}

TEST(DisplayAngle, movesWithoutSolvingAnew) {
    solve::Options options;
    options.error = 0.1;
    options.displayAngle = 8.0;
    solve::Solver solver(std::make_shared<scene::Scene>(scene::buildFurnace(0.5f, true)), options, 2);
    ASSERT_EQ(solver.solve({}), solve::Outcome::reachedError);
    const solve::Counters before = solver.statistics().counters;
    const std::size_t coarse = triangleCount(solver);

    options.displayAngle = 2.0;
    solver.setOptions(options);
    std::size_t published = 0;
    solve::Callbacks callbacks;
    callbacks.publish = [&](const std::shared_ptr<const solve::Snapshot>& snapshot) {
        published += snapshot->finished ? 1u : 0u;
    };
    EXPECT_EQ(solver.solve(callbacks), solve::Outcome::reachedError);
    EXPECT_EQ(published, 1u);
    EXPECT_GT(triangleCount(solver), coarse);
    EXPECT_EQ(solver.statistics().counters.links, before.links);
    EXPECT_EQ(solver.statistics().counters.waves, before.waves);

    options.displayAngle = 8.0;
    solver.setOptions(options);
    EXPECT_EQ(solver.solve({}), solve::Outcome::reachedError);
    EXPECT_EQ(triangleCount(solver), coarse);
}

TEST(DisplayAngle, aLowerErrorStillGoesOn) {
    solve::Options options;
    options.error = 0.2;
    solve::Solver solver(std::make_shared<scene::Scene>(scene::buildFurnace(0.5f, true)), options, 2);
    ASSERT_EQ(solver.solve({}), solve::Outcome::reachedError);
    const std::uint64_t waves = solver.statistics().counters.waves;
    options.error = 0.02;
    solver.setOptions(options);
    EXPECT_EQ(solver.solve({}), solve::Outcome::reachedError);
    EXPECT_GT(solver.statistics().counters.waves, waves);
}

}  // namespace
}  // namespace fluxwalk
