#include <iostream>

#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "core/surface/disk.h"
#include "core/surface/sphere.h"
#include "tests/image/measuring.h"
#include "tests/support/curved_scenes.h"

// T8: a sphere rests on a floor under a disc of light. The shadow at the contact follows the path tracer.

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;

constexpr double kRadius = .5;

scene::Scene sphereOnFloor() {
    scene::Scene scene;
    const std::uint32_t floor = scene::addMaterial(scene, "floor", Rgb(.5f));
    const std::uint32_t ball = scene::addMaterial(scene, "ball", Rgb(.4f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", Rgb(0.0f), Rgb(1000.0f));
    scene::addPolygons(scene, "floor", floor, scene::boxFaces({-1.6, 0, -1.5}, {1.4, 0, 1.5}, scene::kTop));
    scene.objects.push_back({"ball", std::make_shared<surface::Sphere>(Vec3d(0, kRadius, 0), kRadius), ball});
    scene.objects.push_back(
        {"lamp", std::make_shared<surface::Disk>(test::movedTo({.6, 2.2, 0}), .4, 0.0, true), lamp});
    return scene;
}

}  // namespace

TEST(ContactShadow, followsThePathTracer) {
    std::vector<scene::Sensor> sensors;
    for (const double distance : {.03, .07, .15, .25, .4, .6, .9}) {
        for (const double angle : {.3, 2.0, 3.4}) {
            sensors.push_back(
                {Vec3d(distance * std::cos(angle), 0, distance * std::sin(angle)), Vec3d(0, 1, 0)});
        }
    }
    const auto solver = test::solveScene(sphereOnFloor(), .02);
    const solve::Problem& problem = solver->problem();
    const auto measured = image::measure(*solver, sensors);
    const auto traced =
        reference::traceIrradiance(*problem.scene, problem.rays, problem.executor, sensors, {7, 20000});
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        std::cout << i << " " << measured[i].g << " " << traced.irradiance[i].mean.g << " +- "
                  << traced.irradiance[i].standardError.g << "\n";
    }
    const test::Comparison c = test::compare(*solver, sensors, 20000);
    std::cout << "error " << c.error << " se " << c.standardError << " bias " << c.bias << " links "
              << problem.links.links.size() << "\n";
    test::expectAgreement(c, .02);
}

}  // namespace fluxwalk
