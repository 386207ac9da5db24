
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
    // The requested error is a part of the scene's mean; the mean over these sensors, most of them in deep
    // shadow, is a quarter of that.
    const auto solver = test::solveScene(sphereOnFloor(), .005);
    const test::Comparison comparison = test::compare(*solver, sensors, 20000);
    test::expectAgreement(comparison, .02);
}

}  // namespace fluxwalk
