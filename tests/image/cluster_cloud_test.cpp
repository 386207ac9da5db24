#include <gtest/gtest.h>

#include "core/reference/random_sensors.h"
#include "tests/image/measuring.h"
#include "tests/support/hard_scenes.h"

// A cloud of random polygons, solved through clusters, against the Monte-Carlo reference.

namespace fluxwalk {

TEST(SensorsInAPolygonCloud, agreeWithTheReference) {
    const auto solver = test::solveScene(test::buildCloud(6000, 5), .05);
    const solve::Problem& problem = solver->problem();
    EXPECT_GT(problem.links.clusterLinks, 10'000u);
    EXPECT_LT(problem.links.links.size(), 40 * problem.hierarchy.patches().size());
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < problem.scene->objects.size(); ++i) {
        sides.push_back({i, false});
    }
    const auto sensors = reference::randomSensors(*problem.scene, sides, 200, reference::kBenchmarkSeed);
    test::expectAgreement(test::compare(*solver, sensors, 4'000), .05);
}

}  // namespace fluxwalk
