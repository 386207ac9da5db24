
#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/scene/polygons.h"
#include "core/solve/display_update.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"
#include "tests/image/measuring.h"
#include "tests/support/curved_scenes.h"

// Where curved objects touch. T8: a sphere rests on a floor under a disc of light, and the shadow at the
// contact follows the path tracer. A ring embraces a column: between them the light fades to nothing.

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

// The column's patches are quarter turns from +X over -Z.
std::uint32_t patchBelow(const Vec3d& place) {
    const double turn = std::atan2(-place.z, place.x) / (2.0 * base::kPi);
    return static_cast<std::uint32_t>(4.0 * (turn < 0.0 ? turn + 1.0 : turn)) & 3u;
}

constexpr double kColumn = .15;
constexpr double kTube = .04;

scene::Scene ringAroundColumn() {
    scene::Scene scene;
    const std::uint32_t wall = scene::addMaterial(scene, "wall", Rgb(.6f));
    const std::uint32_t lamp = scene::addMaterial(scene, "lamp", Rgb(0.0f), Rgb(3000.0f));
    scene::addPolygons(scene, "room", wall,
                       scene::boxFaces({-2, 0, -2}, {2.3, 3, 2}, scene::kAllFaces, true));
    scene.objects.push_back(
        {"column", std::make_shared<surface::Cylinder>(test::movedTo({0, 1.5, 0}), kColumn, 3.0), wall});
    scene.objects.push_back(
        {"ring", std::make_shared<surface::Torus>(test::movedTo({0, kTube, 0}), kColumn + kTube, kTube),
         wall});
    scene.objects.push_back(
        {"lamp", std::make_shared<surface::Disk>(test::movedTo({1.5, 2.9, .3}), .3, 0.0, true), lamp});
    return scene;
}

}  // namespace

// What the mesh shows around the column, from the circle where the ring touches it upwards: elements must be
// near to squares, though the column's quarters are thirteen times as high as wide.
TEST(ContactShadow, fadesInTheCuspBetweenRingAndColumn) {
    solve::Options options;
    options.error = .02;
    solve::Solver solver(std::make_shared<const scene::Scene>(ringAroundColumn()), options, 2);
    solver.solve({});
    std::vector<solve::Probe> probes;
    std::vector<scene::Sensor> sensors;
    constexpr std::uint32_t kObject = 1;
    constexpr std::size_t kAround = 48;
    const surface::Surface& column = *solver.problem().scene->objects[kObject].surface;
    for (const double height : {.003, .01, .02, .04, .08}) {
        for (std::size_t i = 0; i < kAround; ++i) {
            const double angle = 2.0 * base::kPi * (static_cast<double>(i) + .3) / kAround;
            const Vec3d n(std::cos(angle), 0, std::sin(angle));
            const Vec3d place = kColumn * n + Vec3d(0, kTube + height, 0);
            const std::uint32_t patch = patchBelow(place);
            solve::Probe probe;
            probe.object = kObject;
            probe.patch = patch;
            probe.uv = column.locate(patch, place);
            probe.position = place;
            probe.normal = n;
            probes.push_back(probe);
            sensors.push_back({place, n});
        }
    }
    const auto& problem = solver.problem();
    const reference::PathResult traced =
        reference::traceIrradiance(*problem.scene, problem.rays, problem.executor, sensors, {7, 4000});
    solve::DisplayUpdate display(const_cast<solve::Problem&>(problem));
    const std::vector<Rgb> shown = display.valuesAt(probes);
    std::vector<double> off;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        off.push_back(static_cast<double>(shown[i].g) - traced.irradiance[i].mean.g);
    }
    // How far each is off, and how much farther than its neighbours on both sides: the height of teeth.
    double squares = 0.0;
    double teeth = 0.0;
    for (std::size_t i = 0; i < off.size(); ++i) {
        const std::size_t row = i / kAround * kAround;
        const double beside = .5 * (off[row + (i + 1) % kAround] + off[row + (i + kAround - 1) % kAround]);
        squares += off[i] * off[i] / static_cast<double>(off.size());
        teeth += (off[i] - beside) * (off[i] - beside) / static_cast<double>(off.size());
    }
    // The error is asked for over all surfaces: the cusp is a ten-thousandth of them, and steep. The tracer's
    // own noise is .02.
    const double mean = problem.statistics.meanIrradiance;
    EXPECT_LT(std::sqrt(squares), .2 * mean);
    EXPECT_LT(std::sqrt(teeth), .04 * mean);
}

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
