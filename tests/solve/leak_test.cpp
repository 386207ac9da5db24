#include <gtest/gtest.h>

#include "core/image/sensors.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/solve/solver.h"
#include "tests/support/solving.h"

// The sealed lamp box: walls without thickness, a lamp inside, a room around it.

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;
using scene::Sensor;

constexpr std::uint32_t kRoom = 0;
constexpr std::uint32_t kBox = 1;

solve::Options optionsOf(double error) {
    solve::Options options;
    options.error = error;
    options.clusterLinks = solve::ClusterLinks::on;
    return options;
}

// On the room's floor and walls, on the box from outside, and in the air around it.
std::vector<Sensor> sensorsOutside() {
    std::vector<Sensor> sensors;
    for (int i = 0; i < 20; ++i) {
        const double u = (i + .5) / 20;
        sensors.push_back({{4 * u, 0, 1.3}, {0, 1, 0}});
        sensors.push_back({{0, 3 * u, 2.1}, {1, 0, 0}});
        sensors.push_back({{1.7 + .6 * u, 1.8, 2.0}, {0, 1, 0}});
        sensors.push_back({{1.7, 1.2 + .6 * u, 1.9}, {-1, 0, 0}});
        sensors.push_back({{4 * u, .8, .7}, {0, 1, 0}});
        sensors.push_back({{1.6, 1.5, 4 * u}, {1, 0, 0}});
    }
    return sensors;
}

}  // namespace

TEST(LampBox, nothingOutsideIsLit) {
    solve::Solver solver(std::make_shared<const scene::Scene>(scene::buildLampBox()), optionsOf(.03), 2);
    solver.solve({});
    EXPECT_GT(test::meanIrradiance(solver.problem(), kBox, true).y, 100.0);
    EXPECT_EQ(test::meanIrradiance(solver.problem(), kRoom), Vec3d(0.0));
    EXPECT_EQ(test::meanIrradiance(solver.problem(), kBox, false), Vec3d(0.0));
    bool isInsideShown = false;
    for (const auto& mesh : solver.litMeshes()) {
        const bool isInside = mesh->object == kBox ? mesh->back : mesh->object != kRoom;
        isInsideShown = isInsideShown || isInside;
        for (const Rgb& e : mesh->irradiance) {
            if (!isInside) {
                EXPECT_EQ(e, Rgb(0.0f));
            }
        }
    }
    EXPECT_TRUE(isInsideShown);
    for (const Rgb& e : image::measure(solver, sensorsOutside())) {
        EXPECT_EQ(e, Rgb(0.0f));
    }
}

// A second lamp outside makes light reach both sides of the walls. It is red, the enclosed one green.
TEST(LampBox, wallsThatAreLitFromBothSidesDoNotLeak) {
    scene::Scene scene = scene::buildLampBox();
    scene.materials[scene.objects[2].material].emission = Rgb(0.0f, 10000.0f, 0.0f);
    const std::uint32_t red = scene::addMaterial(scene, "red lamp", Rgb(.5f), Rgb(100.0f, 0.0f, 0.0f));
    scene::addPolygons(scene, "second lamp", red,
                       scene::boxFaces({.5, 2.9, .5}, {.8, 2.9, .8}, scene::kBottom));
    solve::Solver solver(std::make_shared<const scene::Scene>(std::move(scene)), optionsOf(.03), 2);
    solver.solve({});
    const solve::Problem& problem = solver.problem();
    const double inside = test::meanIrradiance(problem, kBox, true).y;
    EXPECT_GT(inside, 100.0);
    EXPECT_GT(test::meanIrradiance(problem, kRoom).x, .1);
    EXPECT_GT(test::meanIrradiance(problem, kBox, false).x, .01);
    EXPECT_LT(test::meanIrradiance(problem, kRoom).y, 1e-6 * inside);
    EXPECT_LT(test::meanIrradiance(problem, kBox, false).y, 1e-6 * inside);
    for (const Rgb& e : image::measure(solver, sensorsOutside())) {
        EXPECT_LT(static_cast<double>(e.g), 1e-6 * inside);
    }
    // And nothing red leaks in.
    EXPECT_LT(test::meanIrradiance(problem, kBox, true).x, 1e-6 * inside);
}

}  // namespace fluxwalk
