#include <filesystem>

#include <gtest/gtest.h>

#include "core/io/gltf_read.h"
#include "core/reference/random_sensors.h"
#include "tests/image/measuring.h"

namespace fluxwalk {

// A Cornell box modelled by others, solved at 2 %, against the built-in reference; the file lies beside the
// project's folder.
TEST(RealScene, cornellBox) {
    const std::filesystem::path file = std::filesystem::path(FLUXWALK_SHARED_SCENES) / "cornell-box.glb";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const auto solver = test::solveScene(io::readGltf(file), .02);
    const solve::Problem& problem = solver->problem();
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < problem.scene->objects.size(); ++i) {
        for (const bool back : {false, true}) {
            if (problem.hierarchy.reached().isReached(i, back)) {
                sides.push_back({i, back});
            }
        }
    }
    const auto sensors = reference::randomSensors(*problem.scene, sides, 300, reference::kBenchmarkSeed);
    const test::Comparison comparison = test::compare(*solver, sensors, 20'000);
    EXPECT_LE(comparison.standardError, .015);
    EXPECT_LE(comparison.error, std::hypot(.022, comparison.standardError));
}

}  // namespace fluxwalk
