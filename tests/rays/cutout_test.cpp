#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/rays/ray_scene.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"

namespace fluxwalk {
namespace {

using base::Vec3;

/// A unit square in z = 0 whose left half is there and whose right half is a hole; behind it, at z = -1, a
/// square without holes.
scene::Scene fence() {
    scene::Scene scene;
    scene.images.push_back({"fence", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    scene.materials.resize(2);
    scene.materials[0].alphaMode = scene::AlphaMode::mask;
    scene.materials[0].reflectanceTexture.image = 0;
    scene.materials[0].reflectanceTexture.wrapU = scene::Wrap::clamp;
    for (const float z : {0.0f, -1.0f}) {
        surface::TriangleSoup soup;
        soup.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
        soup.triangles = {{0, 1, 2}, {0, 2, 3}};
        soup.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        scene.objects.push_back(
            {"square", std::make_shared<surface::PolygonMesh>(soup), z == 0.0f ? 0u : 1u});
    }
    return scene;
}

TEST(CutOut, RaysPassHolesAndMeetWhatIsThere) {
    const scene::Scene scene = fence();
    const rays::RayScene rays(scene, base::Executor(1));
    base::RandomStream random(7);
    int holes = 0;
    for (int i = 0; i < 500; ++i) {
        const auto x = static_cast<float>(0.02 + 0.96 * random.next());
        const auto y = static_cast<float>(0.02 + 0.96 * random.next());
        const bool isHole = x > 0.5f;
        if (x > 0.499f && x < 0.501f) {
            continue;
        }
        holes += isHole ? 1 : 0;
        // Down through the fence, ending between the squares: only the fence can block.
        EXPECT_EQ(rays.isOccluded({{x, y, 0.5f}, 0.0f, {0, 0, -1}, 1.0f}), !isHole) << x << ' ' << y;
        const auto hit = rays.closest({{x, y, 0.5f}, 0.0f, {0, 0, -1}, 10.0f});
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(base::index(hit->object), isHole ? 1u : 0u);
        EXPECT_FLOAT_EQ(hit->t, isHole ? 1.5f : 0.5f);
        // From behind as well.
        EXPECT_EQ(rays.isOccluded({{x, y, -0.5f}, 0.0f, {0, 0, 1}, 1.0f}), !isHole);
    }
    EXPECT_GT(holes, 200);
}

TEST(CutOut, BundlesAgreeWithSingleRays) {
    const scene::Scene scene = fence();
    const rays::RayScene rays(scene, base::Executor(1));
    base::RandomStream random(8);
    std::vector<rays::Ray> bundle;
    for (int i = 0; i < 300; ++i) {
        const Vec3 target(base::Vec3d(1.4 * random.next() - 0.2, 1.4 * random.next() - 0.2, -0.9));
        const Vec3 origin(0.5f, 0.5f, 1.0f);
        bundle.push_back({origin, 0.0f, target - origin, 1.0f});
    }
    std::vector<std::uint8_t> blocked(bundle.size());
    rays.occluded(bundle, blocked);
    std::size_t count = 0;
    for (std::size_t i = 0; i < bundle.size(); ++i) {
        EXPECT_EQ(blocked[i] != 0, rays.isOccluded(bundle[i]));
        count += blocked[i];
    }
    EXPECT_GT(count, 50u);
    EXPECT_LT(count, 250u);
}

TEST(CutOut, ExactSurfacesHaveHolesToo) {
    scene::Scene scene = fence();
    scene.objects.resize(1);
    // The northern half of the sphere is a hole: its texture's upper row.
    scene.images[0] = {"cap", 1, 2, {255, 255, 255, 0, 255, 255, 255, 255}};
    scene.materials[0].reflectanceTexture.wrapV = scene::Wrap::clamp;
    scene.objects[0].surface = std::make_shared<surface::Sphere>(base::Vec3d(0.0), 1.0);
    const rays::RayScene rays(scene, base::Executor(1));
    const rays::Ray down{{0.1f, 5.0f, 0.1f}, 0.0f, {0, -1, 0}, 100.0f};
    const auto hit = rays.closest(down);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->t, 5.0f + std::sqrt(0.98f), 1e-5f);
    EXPECT_TRUE(hit->back);
    EXPECT_TRUE(rays.isOccluded(down));
    // Through the upper half only: two holes.
    EXPECT_FALSE(rays.isOccluded({{-5.0f, 0.5f, 0.1f}, 0.0f, {1, 0, 0}, 100.0f}));
    EXPECT_TRUE(rays.isOccluded({{-5.0f, -0.5f, 0.1f}, 0.0f, {1, 0, 0}, 100.0f}));
}

TEST(CutOut, FactorsDecideWhereThereIsNoTexture) {
    scene::Scene scene = fence();
    scene.objects.resize(1);
    scene.materials[0].reflectanceTexture.image = -1;
    const rays::Ray ray{{0.3f, 0.3f, 0.5f}, 0.0f, {0, 0, -1}, 1.0f};
    scene.materials[0].alpha = 0.4f;
    EXPECT_FALSE(rays::RayScene(scene, base::Executor(1)).isOccluded(ray));
    scene.materials[0].alpha = 0.6f;
    EXPECT_TRUE(rays::RayScene(scene, base::Executor(1)).isOccluded(ray));
}

}  // namespace
}  // namespace fluxwalk
