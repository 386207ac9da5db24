#include "core/image/relief.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/scene/builders.h"
#include "core/solve/solver.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"
#include "tests/support/still_errors.h"

namespace fluxwalk {
namespace {

using base::Vec3d;

// Grey picture of a function of two coordinates in [0, 1).
template <class Function>
scene::Image drawHeights(std::uint32_t width, std::uint32_t height, Function heightAt) {
    scene::Image image{"heights", width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const double value = heightAt((x + 0.5) / width, (y + 0.5) / height);
            const auto byte = static_cast<std::uint8_t>(std::lround(255.0 * value));
            image.rgba.insert(image.rgba.end(), {byte, byte, byte, 255});
        }
    }
    return image;
}

// A triangle in the plane z = 0, 2 m for each unit of texture along x, 4 m along y, where v goes down.
scene::Scene makePlane(scene::Image image) {
    scene::Scene scene;
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}};
    soup.triangles = {{0, 1, 2}};
    soup.texcoords[0] = {{0, 1}, {1, 1}, {0, 0}};
    scene.objects.push_back({"plane", std::make_shared<surface::PolygonMesh>(soup), 0});
    scene.materials.emplace_back();
    scene.images.push_back(std::move(image));
    return scene;
}

Vec3d normalOn(const scene::Scene& scene) {
    const scene::TextureSet textures(scene);
    return image::findReliefNormal(scene, textures, scene.objects[0], 0, {0.3, 0.3}, {0, 0, 1});
}

TEST(Relief, SlopesOfAHeightMapTurnTheNormal) {
    // A height that rises by 1 over the texture's width, which is 2 m.
    scene::Scene scene = makePlane(drawHeights(256, 4, [](double u, double) { return u; }));
    scene.materials[0].bumpTexture.image = 0;
    scene.materials[0].bumpHeight = 0.5f;
    const Vec3d n = normalOn(scene);
    EXPECT_NEAR(n.x / n.z, -0.25, 0.01);
    EXPECT_NEAR(n.y, 0.0, 1e-6);
    // Repeated three times, it is as steep again for each.
    scene.materials[0].bumpTexture.scale = {3.0f, 1.0f};
    EXPECT_NEAR(normalOn(scene).x / normalOn(scene).z, -0.75, 0.03);
}

TEST(Relief, HeightsRiseAgainstV) {
    scene::Scene scene = makePlane(drawHeights(4, 256, [](double, double v) { return v; }));
    scene.materials[0].bumpTexture.image = 0;
    scene.materials[0].bumpHeight = 1.0f;
    // It rises downwards, so the normal leans up.
    EXPECT_NEAR(normalOn(scene).y / normalOn(scene).z, 0.25, 0.01);
}

TEST(Relief, NormalMapsLeanAlongTheTexture) {
    scene::Image image{"normals", 1, 1, {179, 204, 204, 255}};
    scene::Scene scene = makePlane(image);
    scene.materials[0].normalTexture.image = 0;
    const Vec3d stored(2.0 * 179.0 / 255.0 - 1.0, 2.0 * 204.0 / 255.0 - 1.0, 2.0 * 204.0 / 255.0 - 1.0);
    EXPECT_LE(glm::distance(normalOn(scene), glm::normalize(stored)), 1e-5);
    scene.materials[0].normalScale = 0.0f;
    EXPECT_LE(glm::distance(normalOn(scene), Vec3d(0, 0, 1)), 1e-5);
    EXPECT_TRUE(image::hasRelief(scene.materials[0]));
    EXPECT_FALSE(image::hasRelief(scene::Material{}));
}

// A ball with dents, lit in the Cornell box, against paths that start from the same normals.
TEST(Relief, ABumpyBallAgreesWithThePathTracer) {
    scene::Scene scene = *scene::buildScene("cornell-box");
    scene::Material dented;
    dented.reflectance = base::Rgb(0.1f);
    dented.bumpTexture.image = static_cast<std::int32_t>(scene.images.size());
    dented.bumpHeight = 0.006f;
    scene.images.push_back(drawHeights(256, 128, [](double u, double v) {
        return 0.5 + 0.5 * std::sin(12.0 * base::kPi * u) * std::sin(6.0 * base::kPi * v);
    }));
    const auto ball = static_cast<std::uint32_t>(scene.objects.size());
    scene.objects.push_back({"ball", std::make_shared<surface::Sphere>(Vec3d(0.18, 0.3, 0.17), 0.09),
                             static_cast<std::uint32_t>(scene.materials.size())});
    scene.materials.push_back(dented);
    solve::Options options;
    options.errorOf = solve::ErrorOf::gathered;
    solve::Solver solver(std::make_shared<const scene::Scene>(scene), options, 2);
    solver.solve({});
    image::StillOptions still;
    still.width = still.height = 240;
    still.samples = 1;
    // So that not the noise is compared.
    still.rays = {1024, 1024, 1024};
    const image::Still picture = image::takeStill(solver.problem(), scene.cameras.front(), still);
    test::StillPoints points = test::findStillPoints(solver.problem(), scene.cameras.front(), still, 4);
    test::StillPoints onBall;
    double turned = 0.0;
    for (std::size_t i = 0; i < points.pixels.size(); ++i) {
        if (picture.object[points.pixels[i]] == ball + 1) {
            onBall.pixels.push_back(points.pixels[i]);
            onBall.sensors.push_back(points.sensors[i]);
            onBall.reflectance.push_back(points.reflectance[i]);
            const Vec3d smooth = glm::normalize(points.sensors[i].position - Vec3d(0.18, 0.3, 0.17));
            turned = std::max(turned, glm::distance(smooth, points.sensors[i].normal));
        }
    }
    ASSERT_GT(onBall.pixels.size(), 80u);
    EXPECT_GT(turned, 0.25) << "the dents are deep enough to matter";
    const test::StillErrors errors = test::compareStill(solver.problem(), picture, onBall, 32768);
    EXPECT_LE(errors.standardError, 0.015);
    EXPECT_LE(errors.error, 0.02);
}

}  // namespace
}  // namespace fluxwalk
