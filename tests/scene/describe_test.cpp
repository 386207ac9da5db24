#include "core/scene/describe.h"

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"

namespace fluxwalk {
namespace {

using base::Rgb;

std::shared_ptr<const surface::Surface> square(float side) {
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    return std::make_shared<surface::PolygonMesh>(soup);
}

TEST(Describe, CountsAndMeasuresWhatIsThere) {
    scene::Scene scene;
    scene.name = "room";
    scene.materials.resize(3);
    scene.materials[1].emission = Rgb(100.0f, 200.0f, 300.0f);
    scene.materials[2].emission = Rgb(10.0f);
    scene.materials[2].doubleSided = true;
    scene.objects = {{"wall", square(3), 0},
                     {"lamp", square(2), 1},
                     {"globe", std::make_shared<surface::Sphere>(base::Vec3d(5, 0, 0), 1.0), 2}};
    scene::Light light;
    light.name = "bulb";
    light.intensity = Rgb(1.0f);
    scene::Light sun;
    sun.kind = scene::LightKind::directional;
    sun.intensity = Rgb(90000.0f);
    scene.lights = {light, sun};
    scene.cameras.resize(1);
    scene.cameras[0].name = "door";
    scene.warnings = {"something"};
    scene.droppedTriangleCount = 7;

    const scene::SceneDescription d = scene::describeScene(scene, scene::TextureSet(scene));
    EXPECT_EQ(d.name, "room");
    EXPECT_EQ(d.objects, 3u);
    EXPECT_EQ(d.patches, 10u);
    EXPECT_EQ(d.sides, 20u);
    EXPECT_EQ(d.triangles, 4u);
    EXPECT_EQ(d.droppedTriangles, 7u);
    EXPECT_NEAR(d.area, 9.0 + 4.0 + 4.0 * base::kPi, 1e-6);
    EXPECT_NEAR(d.emittingArea, 4.0 + 4.0 * base::kPi, 1e-6);
    EXPECT_NEAR(d.doubleSidedArea, 4.0 * base::kPi, 1e-6);
    ASSERT_EQ(d.kinds.size(), 2u);
    EXPECT_EQ(d.kinds[0].kind, "polygon mesh");
    EXPECT_EQ(d.kinds[0].objects, 2u);
    EXPECT_NEAR(d.kinds[0].area, 13.0, 1e-6);
    EXPECT_EQ(d.kinds[1].kind, "sphere");
    EXPECT_EQ(d.kinds[1].patches, 8u);
    ASSERT_EQ(d.emitters.size(), 2u);
    EXPECT_EQ(d.emitters[0].object, "lamp");
    EXPECT_NEAR(d.emitters[0].flux.g, 800.0, 1e-3);
    EXPECT_NEAR(d.emitters[0].lumens, 4.0 * (0.2126 * 100 + 0.7152 * 200 + 0.0722 * 300), 1e-3);
    // Both sides.
    EXPECT_NEAR(d.emitters[1].lumens, 2.0 * 10.0 * 4.0 * base::kPi, 1e-3);
    ASSERT_EQ(d.lights.size(), 2u);
    EXPECT_NEAR(d.lights[0].lumens, 4.0 * base::kPi, 1e-4);
    EXPECT_EQ(d.lights[1].lumens, 0.0);
    EXPECT_NEAR(d.lumens, d.emitters[0].lumens + d.emitters[1].lumens + d.lights[0].lumens, 1e-9);
    EXPECT_EQ(d.cameras, std::vector<std::string>{"door"});
    EXPECT_EQ(d.warnings, std::vector<std::string>{"something"});
    EXPECT_EQ(d.bounds.upper, base::Vec3d(6, 3, 1));
    EXPECT_EQ(scene::nameOf(scene::LightKind::spot), "spot");
}

}  // namespace
}  // namespace fluxwalk
