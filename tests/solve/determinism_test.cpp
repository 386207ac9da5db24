#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// Check 28: the same bits for any number of threads.

namespace fluxwalk {

namespace {

struct NamedValue {
    std::uint32_t object;
    std::uint32_t patchSide;
    surface::Path path;
    base::Rgb irradiance;
    bool operator==(const NamedValue&) const = default;
};

std::vector<NamedValue> solveWith(const scene::Scene& scene, unsigned threads,
                                  solve::Statistics& statistics) {
    solve::Options options;
    options.error = .05;
    solve::Solver solver(std::make_shared<const scene::Scene>(scene), options, threads);
    solver.solve({});
    statistics = solver.statistics();
    const hierarchy::Hierarchy& h = solver.problem().hierarchy;
    std::vector<NamedValue> values;
    for (const base::NodeId id : test::leavesOf(h)) {
        const hierarchy::ElementName name = h.name(id);
        values.push_back(
            {name.object, name.patch * 2 + (name.back ? 1u : 0u), name.path, h.light(id).irradiance});
    }
    return values;
}

void expectSameForAnyThreads(const scene::Scene& scene) {
    solve::Statistics one;
    const std::vector<NamedValue> expected = solveWith(scene, 1, one);
    EXPECT_GT(expected.size(), 300u);
    for (const unsigned threads : {2u, 8u}) {
        solve::Statistics other;
        EXPECT_EQ(solveWith(scene, threads, other), expected) << threads;
        EXPECT_EQ(other.counters.links, one.counters.links);
        EXPECT_EQ(other.counters.rays, one.counters.rays);
        EXPECT_EQ(other.counters.sweeps, one.counters.sweeps);
        EXPECT_EQ(other.estimatedError, one.estimatedError);
        EXPECT_EQ(other.audit.escaped, one.audit.escaped);
    }
}

}  // namespace

TEST(Determinism, cornellBox) {
    expectSameForAnyThreads(*scene::buildScene("cornell-box"));
}

// Curved elements and a closed room.
TEST(Determinism, furnace) {
    expectSameForAnyThreads(*scene::buildScene("furnace"));
}

// Another seed is another sample of the same solution.
TEST(Determinism, seedsDiffer) {
    const auto scene = std::make_shared<const scene::Scene>(*scene::buildScene("cornell-box"));
    solve::Options options;
    options.error = .05;
    std::array<base::Vec3d, 2> floor{};
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        options.seed = seed;
        solve::Solver solver(scene, options, 2);
        solver.solve({});
        floor[seed - 1] = test::meanIrradiance(solver.problem(), 0);
    }
    EXPECT_NE(floor[0], floor[1]);
    EXPECT_NEAR(floor[0].y / floor[1].y, 1.0, .02);
}

}  // namespace fluxwalk
