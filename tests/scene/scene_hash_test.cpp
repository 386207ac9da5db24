#include "core/scene/scene_hash.h"

#include <functional>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"

namespace fluxwalk {
namespace {

using scene::hashScene;
using scene::Scene;

// A textured triangle, a sphere and a lamp without area.
Scene makeScene(float corner = 1.0f, double radius = 0.5) {
    Scene scene;
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {corner, 0, 0}, {0, 0, 1}};
    soup.triangles = {{0, 1, 2}};
    soup.texcoords[0] = {{0, 0}, {1, 0}, {0, 1}};
    scene.objects.push_back({"triangle", std::make_shared<surface::PolygonMesh>(soup), 0});
    scene.objects.push_back({"ball", std::make_shared<surface::Sphere>(base::Vec3d(0, 2, 0), radius), 0});
    scene.materials.emplace_back();
    scene.materials[0].reflectanceTexture.image = 0;
    scene.images.push_back({"checks", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}});
    scene.lights.emplace_back();
    return scene;
}

TEST(SceneHash, TheSameSceneIsTheSame) {
    EXPECT_EQ(hashScene(makeScene()), hashScene(makeScene()));
    EXPECT_EQ(hashScene(*scene::buildScene("gallery")), hashScene(*scene::buildScene("gallery")));
}

TEST(SceneHash, WhatIsNotLightDoesNotCount) {
    Scene scene = makeScene();
    scene.name = "other";
    scene.objects[0].name = "other";
    scene.materials[0].name = "other";
    scene.materials[0].normalScale = 2.0f;
    scene.cameras.emplace_back();
    scene.warnings.emplace_back("other");
    EXPECT_EQ(hashScene(scene), hashScene(makeScene()));
}

TEST(SceneHash, WhateverLightDependsOnCounts) {
    const std::vector<std::function<void(Scene&)>> changes = {
        [](Scene& s) { s.objects[0].material = 1; },
        [](Scene& s) { std::swap(s.objects[0], s.objects[1]); },
        [](Scene& s) { s.objects.pop_back(); },
        [](Scene& s) { s.materials[0].reflectance.g = 0.5001f; },
        [](Scene& s) { s.materials[0].emission.b = 1e-3f; },
        [](Scene& s) { s.materials[0].doubleSided = true; },
        [](Scene& s) { s.materials[0].alphaMode = scene::AlphaMode::mask; },
        [](Scene& s) { s.materials[0].alphaCutoff = 0.4f; },
        [](Scene& s) { s.materials[0].reflectanceTexture.image = -1; },
        [](Scene& s) { s.materials[0].reflectanceTexture.offset.x = 0.25f; },
        [](Scene& s) { s.materials[0].reflectanceTexture.wrapV = scene::Wrap::mirror; },
        [](Scene& s) { s.images[0].rgba[5] = 254; },
        [](Scene& s) { s.lights[0].intensity.r = 2.0f; },
        [](Scene& s) { s.lights[0].position.y = 1e-9; },
        [](Scene& s) { s.lights.clear(); },
        [](Scene& s) { s.sky = base::Rgb(1.0f); },
        [](Scene& s) { s = makeScene(std::nextafter(1.0f, 2.0f)); },
        [](Scene& s) { s = makeScene(1.0f, 0.5000001); },
    };
    const std::uint64_t before = hashScene(makeScene());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Scene scene = makeScene();
        scene.materials.resize(2);
        const std::uint64_t unchanged = hashScene(scene);
        changes[i](scene);
        EXPECT_NE(hashScene(scene), unchanged) << i;
        EXPECT_NE(hashScene(scene), before) << i;
    }
}

}  // namespace
}  // namespace fluxwalk
