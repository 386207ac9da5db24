#include "core/reference/path_tracer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/reference/random_sensors.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/surface/sphere.h"
#include "tests/analytic/closed_forms.h"
#include "tests/reference/z_test.h"
#include "tests/support/patch_subset.h"

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;
using reference::Estimate;
using reference::PathResult;
using scene::Scene;
using scene::Sensor;
using test::expectEstimate;
namespace cf = closed_forms;

PathResult trace(const Scene& scene, const std::vector<Sensor>& sensors, std::uint64_t paths,
                 unsigned threads = 2) {
    const base::Executor executor(threads);
    const rays::RayScene rays(scene, executor);
    return reference::traceIrradiance(scene, rays, executor, sensors, {11, paths});
}

void addSphere(Scene& scene, std::uint32_t material, double radius, bool inside) {
    scene.objects.push_back({inside ? "shell" : "ball",
                             std::make_shared<surface::Sphere>(Vec3d(.3, -.2, .1), radius, inside),
                             material});
}

// Ball of radius q in a shell of radius 1 that is lit from inside.
Scene concentricSpheres(double q, const Rgb& ballEmission, float ballRho, const Rgb& shellEmission,
                        float shellRho) {
    Scene scene;
    addSphere(scene, scene::addMaterial(scene, "ball", Rgb(ballRho), ballEmission), q, false);
    addSphere(scene, scene::addMaterial(scene, "shell", Rgb(shellRho), shellEmission), 1.0, true);
    return scene;
}

Scene groundUnder(const Rgb& sky) {
    Scene scene;
    const std::uint32_t black = scene::addMaterial(scene, "black", Rgb(0.0f));
    scene::addPolygons(scene, "ground", black, scene::boxFaces({-5, 0, -5}, {5, 0, 5}, scene::kTop));
    scene.sky = sky;
    return scene;
}

}  // namespace

TEST(PathTracer, pointsUnderARectangle) {
    const Scene squares = scene::buildParallelSquares(1.0);
    const std::vector<Sensor> sensors{
        {{0, 0, 0}, {0, 1, 0}}, {{.5, 0, .5}, {0, 1, 0}}, {{.25, .5, .5}, {0, 1, 0}}};
    const PathResult result = trace(squares, sensors, 300000);
    expectEstimate(result.irradiance[0], cf::pointParallelRectangle(1, 1, 1), 5e-4, 1e-5);
    expectEstimate(result.irradiance[1], 4.0 * cf::pointParallelRectangle(.5, .5, 1), 5e-4, 1e-5);
    const double aside =
        2.0 * (cf::pointParallelRectangle(.25, .5, .5) + cf::pointParallelRectangle(.75, .5, .5));
    expectEstimate(result.irradiance[2], aside, 5e-4, 1e-5);
}

TEST(PathTracer, emissionLeavesTheFrontOnlyUnlessDoubleSided) {
    Scene squares = scene::buildParallelSquares(1.0);
    const std::vector<Sensor> above{{{.5, 2, .5}, {0, -1, 0}}};
    EXPECT_EQ(trace(squares, above, 2000).irradiance[0].mean, Vec3d(0.0));
    squares.materials[squares.objects[0].material].doubleSided = true;
    expectEstimate(trace(squares, above, 40000).irradiance[0], 4.0 * cf::pointParallelRectangle(.5, .5, 1),
                   5e-4);
}

TEST(PathTracer, furnace) {
    const base::Executor executor(2);
    for (const float rho : {.5f, .9f}) {
        const Scene furnace = scene::buildFurnace(rho, true);
        std::vector<reference::ObjectSide> sides;
        for (std::uint32_t i = 0; i < furnace.objects.size(); ++i) {
            sides.push_back({i, false});
        }
        const auto sensors = reference::randomSensors(furnace, sides, 40, 3);
        const double expected = 1.0 / (1.0 - static_cast<double>(rho));
        const PathResult result = trace(furnace, sensors, 4000);
        for (const Estimate& e : result.irradiance) {
            expectEstimate(e, expected, .03 * expected, 2e-4 * expected);
        }
    }
}

// ALGORITHMS 3.5: one octant of an integrating sphere emits 1, rho = .8: H = .625 at every point.
TEST(PathTracer, integratingSphereWithOneBrightOctant) {
    Scene scene;
    const auto shell = std::make_shared<surface::Sphere>(Vec3d(1, 2, 3), 1.5, true);
    const std::uint32_t bright = scene::addMaterial(scene, "bright", Rgb(.8f), Rgb(1.0f));
    const std::uint32_t dark = scene::addMaterial(scene, "dark", Rgb(.8f));
    scene.objects.push_back({"octant", std::make_shared<test::PatchSubset>(shell, std::vector{2u}), bright});
    scene.objects.push_back(
        {"rest", std::make_shared<test::PatchSubset>(shell, std::vector{0u, 1u, 3u, 4u, 5u, 6u, 7u}), dark});
    const std::vector<reference::ObjectSide> sides{{0, false}, {1, false}};
    const auto sensors = reference::randomSensors(scene, sides, 12, 5);
    for (const Estimate& e : trace(scene, sensors, 40000).irradiance) {
        expectEstimate(e, .625, .004, 1e-4);
    }
}

// ALGORITHMS 3.4 and 3.7: two zones in closed form, and the part of the shell that the ball leaves visible.
TEST(PathTracer, concentricSpheres) {
    const Vec3d center(.3, -.2, .1);
    const Vec3d up = glm::normalize(Vec3d(.3, 1, .2));
    const Scene zones = concentricSpheres(.5, Rgb(1.0f), .5f, Rgb(0.0f), .8f);
    const PathResult result = trace(zones, {{center + .5 * up, up}, {center + up, -up}}, 60000);
    expectEstimate(result.irradiance[0], 2.0 / 3.0, .004, 1e-4);
    expectEstimate(result.irradiance[1], .8333333, .004, 1e-4);
    for (const double q : {.25, .5, .8}) {
        const Scene glow = concentricSpheres(q, Rgb(0.0f), 0.0f, Rgb(1.0f), 0.0f);
        expectEstimate(trace(glow, {{center + up, -up}}, 60000).irradiance[0], 1.0 - q * q, .002, 1e-4);
    }
}

// ALGORITHMS 3.6: direct light exactly, total light at a face's centre.
TEST(PathTracer, pointSourceInACube) {
    const std::vector<Sensor> centre{{{2, 0, 2}, {0, 1, 0}}};
    expectEstimate(trace(scene::buildCie58(0.0f), centre, 10).irradiance[0], 198.9437, 1e-9, 2e-4);
    expectEstimate(trace(scene::buildCie58(.5f), centre, 150000).irradiance[0], 310.98, .5, .02);
    expectEstimate(trace(scene::buildCie58(.8f), centre, 100000).irradiance[0], 629.92, 2.0, .02);
}

TEST(PathTracer, spotDirectionalAndRange) {
    Scene scene = groundUnder(Rgb(0.0f));
    scene::Light spot;
    spot.kind = scene::LightKind::spot;
    spot.position = {0, 2, 0};
    spot.intensity = Rgb(100.0f, 50.0f, 0.0f);
    spot.innerConeAngle = .3;
    spot.outerConeAngle = .5;
    scene.lights.push_back(spot);
    const Sensor below{{0, 0, 0}, {0, 1, 0}};
    const Sensor outside{{2, 0, 0}, {0, 1, 0}};
    PathResult result = trace(scene, {below, outside}, 4);
    EXPECT_NEAR(result.irradiance[0].mean.x, 25.0, 1e-5);
    EXPECT_NEAR(result.irradiance[0].mean.y, 12.5, 1e-5);
    EXPECT_EQ(result.irradiance[1].mean, Vec3d(0.0));
    scene.lights[0].range = 1.5;
    EXPECT_EQ(trace(scene, {below}, 4).irradiance[0].mean, Vec3d(0.0));
    scene.lights[0].kind = scene::LightKind::directional;
    scene.lights[0].direction = glm::normalize(Vec3d(1, -1, 0));
    EXPECT_NEAR(trace(scene, {below}, 4).irradiance[0].mean.x, 100.0 * std::sqrt(.5), 1e-4);
    // A parasol shades it.
    scene::addPolygons(scene, "parasol", 0, scene::boxFaces({-1.5, 1, -.5}, {-.5, 1, .5}, scene::kTop));
    EXPECT_EQ(trace(scene, {below}, 4).irradiance[0].mean, Vec3d(0.0));
}

TEST(PathTracer, uniformSky) {
    const Scene open = groundUnder(Rgb(100.0f, 200.0f, 300.0f));
    const PathResult result = trace(open, {{{0, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}}}, 40000);
    expectEstimate(result.irradiance[0], Vec3d(100, 200, 300), 1e-6, 1e-6);
    expectEstimate(result.irradiance[1], Vec3d(50, 100, 150), 1.0, 1e-3);
    // CIE 171 test 5.9: room 4 x 4 x 3 m, black, roof opening of 1 m2 in the middle: 3.4107 % of the sky.
    Scene room = groundUnder(Rgb(1.0f));
    const scene::Quads walls = scene::boxFaces({-2, 0, -2}, {2, 3, 2}, scene::kAround, true);
    const scene::Quads roof = scene::join({scene::boxFaces({-2, 3, -2}, {-.5, 3, 2}, scene::kBottom),
                                           scene::boxFaces({.5, 3, -2}, {2, 3, 2}, scene::kBottom),
                                           scene::boxFaces({-.5, 3, -2}, {.5, 3, -.5}, scene::kBottom),
                                           scene::boxFaces({-.5, 3, .5}, {.5, 3, 2}, scene::kBottom)});
    scene::addPolygons(room, "walls", 0, scene::join({walls, roof}));
    const PathResult inside = trace(room, {{{0, 0, 0}, {0, 1, 0}}, {{1.75, 0, 1.75}, {0, 1, 0}}}, 400000);
    expectEstimate(inside.irradiance[0], .034107, 5e-4, 1e-5);
    expectEstimate(inside.irradiance[1], .012580, 5e-4, 1e-5);
}

TEST(PathTracer, nothingLeavesTheSealedLampBox) {
    const Scene scene = scene::buildLampBox();
    const std::vector<reference::ObjectSide> outside{{0, false}, {1, false}};
    const auto sensors = reference::randomSensors(scene, outside, 50, 9);
    for (const Estimate& e : trace(scene, sensors, 500).irradiance) {
        EXPECT_EQ(e.mean, Vec3d(0.0));
    }
    const std::vector<reference::ObjectSide> within{{1, true}};
    for (const Estimate& e : trace(scene, reference::randomSensors(scene, within, 5, 9), 500).irradiance) {
        EXPECT_GT(e.mean.x, 100.0);
    }
}

TEST(PathTracer, resultDoesNotDependOnThreads) {
    const Scene box = *scene::buildScene("cornell-box");
    const std::vector<reference::ObjectSide> sides{{0, false}, {5, false}};
    const auto sensors = reference::randomSensors(box, sides, 7, 1);
    const PathResult one = trace(box, sensors, 1500, 1);
    const PathResult three = trace(box, sensors, 1500, 3);
    EXPECT_EQ(one.rays, three.rays);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        EXPECT_EQ(one.irradiance[i].mean, three.irradiance[i].mean);
        EXPECT_EQ(one.irradiance[i].standardError, three.irradiance[i].standardError);
    }
}

}  // namespace fluxwalk
