#include "core/reference/photon_tracer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "tests/reference/z_test.h"

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;
using reference::Estimate;
using reference::PhotonResult;
using scene::Scene;
using test::expectEstimate;

PhotonResult trace(const Scene& scene, std::uint64_t particles, unsigned threads = 2) {
    const base::Executor executor(threads);
    const rays::RayScene rays(scene, executor);
    return reference::tracePhotons(scene, rays, executor, {21, particles});
}

}  // namespace

// Check 23 of ALGORITHMS section 4, table 3.10. The table's own error is 5e-4 on big faces, up to .7 % on
// small.
TEST(PhotonTracer, cornellBoxTable) {
    const PhotonResult result = trace(*scene::buildScene("cornell-box-unit"), 1'000'000);
    const auto expectTable = [](const char* name, const Estimate& e, const Vec3d& table, double relative) {
        SCOPED_TRACE(name);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(e.standardError[c], .05 * table[c]);
            EXPECT_NEAR(e.mean[c], table[c], 4.0 * e.standardError[c] + relative * table[c]);
        }
    };
    const auto object = [&](std::size_t i) -> const Estimate& { return result.objectIrradiance[i][0]; };
    const auto face = [&](std::size_t i, std::size_t p) -> const Estimate& {
        return result.patchIrradiance[i][p][0];
    };
    expectTable("floor", object(0), {.009044, .008701, .007380}, 5e-4);
    expectTable("ceiling", object(1), {.008243, .007107, .005226}, 5e-4);
    expectTable("back wall", object(2), {.013722, .013016, .010990}, 5e-4);
    expectTable("right wall", object(3), {.014791, .014143, .012625}, 5e-4);
    expectTable("left wall", object(4), {.013151, .012031, .010785}, 5e-4);
    expectTable("lamp", object(7), {.011320, .010172, .008020}, 3e-3);
    expectTable("short top", face(5, 0), {.025756, .026085, .023973}, 3e-3);
    expectTable("short 82,225..130,65", face(5, 1), {.001456, .003734, .000942}, 7e-3);
    expectTable("short 240,272..82,225", face(5, 2), {.007969, .009762, .006456}, 7e-3);
    expectTable("short 290,114..240,272", face(5, 3), {.008700, .006332, .005657}, 7e-3);
    expectTable("short 130,65..290,114", face(5, 4), {.001112, .000703, .000592}, 7e-3);
    expectTable("tall top", face(6, 0), {.058968, .056371, .054931}, 3e-3);
    expectTable("tall 265,296..423,247", face(6, 1), {.006431, .005781, .004862}, 7e-3);
    expectTable("tall 314,456..265,296", face(6, 2), {.007488, .009659, .006018}, 7e-3);
    expectTable("tall 472,406..314,456", face(6, 3), {.008030, .005604, .004589}, 7e-3);
    expectTable("tall 423,247..472,406", face(6, 4), {.006844, .000958, .000739}, 7e-3);

    const double emitted = .01365;
    expectEstimate(result.emitted, emitted, 1e-9, 1e-8);
    expectTable("escaped", result.escaped, emitted * Vec3d(.323153, .298231, .261259), 5e-4);
    // Balance: the roulette's noise is all that separates the two sides.
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(result.absorbed.mean[c] + result.escaped.mean[c], emitted, 5e-3 * emitted);
    }
}

// ALGORITHMS 3.6: mean total irradiance Phi / (S (1 - rho)).
TEST(PhotonTracer, pointSourceInACube) {
    for (const float rho : {0.0f, .5f, .9f}) {
        const PhotonResult result = trace(scene::buildCie58(rho), 200'000);
        const double mean = 10000.0 / (96.0 * (1.0 - static_cast<double>(rho)));
        expectEstimate(result.objectIrradiance[0][0], mean, .01 * mean, 1e-4 * mean);
        expectEstimate(result.escaped, 0.0, 1e-12);
        expectEstimate(result.objectIrradiance[0][1], 0.0, 1e-12);
    }
}

TEST(PhotonTracer, spotFluxSkyAndSun) {
    Scene scene;
    const std::uint32_t black = scene::addMaterial(scene, "black", Rgb(0.0f));
    scene::addPolygons(scene, "ground", black, scene::boxFaces({-50, 0, -50}, {50, 0, 50}, scene::kTop));
    scene::Light spot;
    spot.kind = scene::LightKind::spot;
    spot.position = {0, 2, 0};
    spot.direction = {0, -1, 0};
    spot.intensity = Rgb(100.0f);
    spot.innerConeAngle = .4;
    spot.outerConeAngle = 1.2;
    scene.lights.push_back(spot);
    const double flux = static_cast<double>(scene::fluxOf(spot).r);
    const PhotonResult lit = trace(scene, 200'000);
    expectEstimate(lit.emitted, flux, .01 * flux);
    expectEstimate(lit.objectIrradiance[0][0], flux / 1e4, .01 * flux / 1e4);

    scene.lights[0].kind = scene::LightKind::directional;
    scene.lights[0].direction = glm::normalize(Vec3d(1, -1, 0));
    scene.sky = Rgb(30.0f);
    // Half of the sky's light that enters the bounding sphere meets the ground from above.
    const PhotonResult day = trace(scene, 400'000);
    expectEstimate(day.objectIrradiance[0][0], 100.0 * std::sqrt(.5) + 30.0, .5, .01);
    expectEstimate(day.objectIrradiance[0][1], 0.0, 1e-12);
}

TEST(PhotonTracer, doubleSidedEmittersSendFromBothSides) {
    Scene squares = scene::buildParallelSquares(1.0);
    squares.materials[squares.objects[0].material].doubleSided = true;
    const PhotonResult result = trace(squares, 100'000);
    expectEstimate(result.emitted, 2.0, 1e-9);
    expectEstimate(result.objectIrradiance[1][0], .199824896, .003);
}

TEST(PhotonTracer, nothingLeavesTheSealedLampBox) {
    const PhotonResult result = trace(scene::buildLampBox(), 100'000);
    EXPECT_EQ(result.objectIrradiance[0][0].mean, Vec3d(0.0));
    EXPECT_EQ(result.objectIrradiance[1][0].mean, Vec3d(0.0));
    EXPECT_GT(result.objectIrradiance[1][1].mean.x, 100.0);
}

TEST(PhotonTracer, resultDoesNotDependOnThreads) {
    const Scene box = *scene::buildScene("cornell-box");
    const PhotonResult one = trace(box, 20'000, 1);
    const PhotonResult three = trace(box, 20'000, 3);
    EXPECT_EQ(one.rays, three.rays);
    EXPECT_EQ(one.escaped.mean, three.escaped.mean);
    for (std::size_t i = 0; i < box.objects.size(); ++i) {
        EXPECT_EQ(one.objectIrradiance[i][0].mean, three.objectIrradiance[i][0].mean);
    }
}

}  // namespace fluxwalk
