#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "tests/image/measuring.h"

// Sensors in free space get links of their own.

namespace fluxwalk {

namespace {

std::vector<scene::Sensor> grid(const base::Vec3d& lower, const base::Vec3d& upper, const base::Vec3d& normal,
                                int side) {
    std::vector<scene::Sensor> sensors;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const base::Vec3d part((i + .5) / side, .5, (j + .5) / side);
            sensors.push_back({lower + part * (upper - lower), normal});
        }
    }
    return sensors;
}

// An empty room of 4 m x 3 m x 2.7 m with a lamp panel in its ceiling.
scene::Scene makeOffice() {
    scene::Scene scene;
    const std::uint32_t wall = scene::addMaterial(scene, "wall", base::Rgb(.6f, .55f, .5f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", base::Rgb(.5f), base::Rgb(8000.0f));
    scene::addPolygons(scene, "room", wall, scene::boxFaces({0, 0, 0}, {4, 2.7, 3}, scene::kAllFaces, true));
    scene::addPolygons(scene, "lamp", lamp,
                       scene::boxFaces({1.7, 2.6, 1.2}, {2.3, 2.6, 1.8}, scene::kBottom));
    return scene;
}

}  // namespace

// The lighting designer's normal case: horizontal illuminance at .8 m.
TEST(SensorsInSpace, workPlane) {
    const auto solver = test::solveScene(makeOffice(), .02);
    test::expectAgreement(test::compare(*solver, grid({.2, .8, .2}, {3.8, .8, 2.8}, {0, 1, 0}, 8), 20'000),
                          .02);
}

// Any direction, so that lamp, walls and floor all count.
TEST(SensorsInSpace, otherDirections) {
    const auto solver = test::solveScene(makeOffice(), .02);
    for (const base::Vec3d& normal :
         {base::Vec3d(0, -1, 0), base::Vec3d(1, 0, 0), base::Vec3d(.6, .48, .64)}) {
        test::expectAgreement(test::compare(*solver, grid({.5, 1.2, .5}, {3.5, 1.2, 2.5}, normal, 6), 20'000),
                              .02);
    }
}

// Between the blocks, partly in their shadow.
TEST(SensorsInSpace, cornellBox) {
    const auto solver = test::solveScene(*scene::buildScene("cornell-box"), .02);
    test::expectAgreement(
        test::compare(*solver, grid({.02, .36, .02}, {.53, .36, .54}, {0, 1, 0}, 9), 20'000), .03);
}

}  // namespace fluxwalk
