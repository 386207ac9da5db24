#include <gtest/gtest.h>

#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"
#include "tests/image/measuring.h"

// Sensors on surfaces against the Monte-Carlo reference, which shares no sampling or visibility code.

namespace fluxwalk {

namespace {

std::vector<reference::ObjectSide> fronts(const scene::Scene& scene) {
    std::vector<reference::ObjectSide> sides;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        sides.push_back({i, false});
    }
    return sides;
}

}  // namespace

TEST(SensorsOnSurfaces, cornellBox) {
    const auto solver = test::solveScene(*scene::buildScene("cornell-box"), .02);
    const scene::Scene& scene = *solver->problem().scene;
    const auto sensors = reference::randomSensors(scene, fronts(scene), 200, reference::kBenchmarkSeed);
    test::expectAgreement(test::compare(*solver, sensors, 20'000), .02);
}

// The darker room gets all its light through the door.
TEST(SensorsOnSurfaces, lightThroughADoor) {
    const auto solver = test::solveScene(scene::buildTwoRooms(), .02);
    std::vector<scene::Sensor> sensors;
    for (int i = 0; i < 40; ++i) {
        const double u = (i + .5) / 40;
        sensors.push_back({{4.5 + 3.0 * u, 2.6, 1.2 + std::fmod(3.7 * u, 1.2)}, {0, -1, 0}});
        sensors.push_back({{8.12, .8 + 1.6 * std::fmod(7.3 * u, 1.0), 1.2 + u}, {-1, 0, 0}});
    }
    test::expectAgreement(test::compare(*solver, sensors, 4'000), .1);
}

}  // namespace fluxwalk
