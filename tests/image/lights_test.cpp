#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "tests/image/measuring.h"

// Lights without area and the sky, against the Monte-Carlo reference: a court with two walls and a block.

namespace fluxwalk {

namespace {

using base::Rgb;
using base::Vec3d;

scene::Scene makeCourt() {
    scene::Scene scene;
    const std::uint32_t stone = scene::addMaterial(scene, "stone", Rgb(.5f, .45f, .4f));
    const std::uint32_t brick = scene::addMaterial(scene, "brick", Rgb(.6f, .3f, .2f));
    scene::addPolygons(scene, "ground", stone, scene::boxFaces({0, 0, 0}, {6, 0, 6}, scene::kTop));
    scene::addPolygons(scene, "walls", brick,
                       scene::boxFaces({0, 0, 0}, {6, 3, 6}, scene::kLeft | scene::kFar, true));
    scene::addPolygons(scene, "block", stone, scene::boxFaces({2, 0, 2}, {3, 1.5, 3.5}, scene::kStanding));
    return scene;
}

// Over ground, walls and block, none near a shadow's edge by design.
std::vector<scene::Sensor> sensors() {
    std::vector<scene::Sensor> all;
    for (int i = 0; i < 30; ++i) {
        const double u = (i + .5) / 30;
        const double v = std::fmod(.03 + i * .618034, 1.0);
        all.push_back({{6 * u, 0, 6 * v}, {0, 1, 0}});
        all.push_back({{0, 3 * v, 6 * u}, {1, 0, 0}});
        all.push_back({{6 * u, 3 * v, 6}, {0, 0, -1}});
        all.push_back({{2 + u, 1.5, 2 + 1.5 * v}, {0, 1, 0}});
        all.push_back({{3, 1.5 * v, 2 + 1.5 * u}, {1, 0, 0}});
    }
    // Not under the block.
    std::erase_if(all, [](const scene::Sensor& s) {
        return s.position.y == 0.0 && s.position.x > 1.9 && s.position.x < 3.1 && s.position.z > 1.9 &&
               s.position.z < 3.6;
    });
    return all;
}

void expectAgreement(const scene::Scene& scene, double error) {
    const auto solver = test::solveScene(scene, error);
    test::expectAgreement(test::compare(*solver, sensors(), 10'000), error);
}

}  // namespace

TEST(Lights, sky) {
    scene::Scene scene = makeCourt();
    scene.sky = Rgb(900.0f, 1000.0f, 1200.0f);
    expectAgreement(scene, .02);
}

TEST(Lights, sun) {
    scene::Scene scene = makeCourt();
    scene::Light sun;
    sun.kind = scene::LightKind::directional;
    sun.direction = glm::normalize(Vec3d(-.5, -1, .3));
    sun.intensity = Rgb(1000.0f, 950.0f, 800.0f);
    scene.lights.push_back(sun);
    expectAgreement(scene, .02);
}

TEST(Lights, spot) {
    scene::Scene scene = makeCourt();
    scene::Light spot;
    spot.kind = scene::LightKind::spot;
    spot.position = {4.5, 2.8, 1.0};
    spot.direction = glm::normalize(Vec3d(-.4, -1, .5));
    spot.intensity = Rgb(300.0f);
    spot.innerConeAngle = .3;
    spot.outerConeAngle = .9;
    scene.lights.push_back(spot);
    expectAgreement(scene, .03);
}

TEST(Lights, all) {
    scene::Scene scene = makeCourt();
    scene.sky = Rgb(200.0f);
    scene::Light bulb;
    bulb.position = {1.0, 2.0, 5.0};
    bulb.intensity = Rgb(150.0f, 120.0f, 80.0f);
    scene.lights.push_back(bulb);
    scene::Light sun;
    sun.kind = scene::LightKind::directional;
    sun.direction = glm::normalize(Vec3d(-.2, -1, .6));
    sun.intensity = Rgb(300.0f);
    scene.lights.push_back(sun);
    expectAgreement(scene, .02);
}

}  // namespace fluxwalk
