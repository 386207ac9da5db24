#include "core/rays/ray_scene.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_scenes.h"

namespace fluxwalk {
namespace {

using base::Vec3;
using base::Vec3d;
using rays::Ray;
using rays::RayScene;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct TrueHit {
    std::uint32_t object = 0;
    surface::SurfaceHit at;
};

// Nearest hit over all objects by Surface::intersect.
std::optional<TrueHit> bruteForce(const scene::Scene& scene, const Ray& ray) {
    std::optional<TrueHit> best;
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        const auto hit = scene.objects[o].surface->intersect(Vec3d(ray.origin), Vec3d(ray.direction),
                                                             static_cast<double>(ray.tNear),
                                                             static_cast<double>(ray.tFar));
        if (hit && (!best || hit->t < best->at.t)) {
            best = TrueHit{o, *hit};
        }
    }
    return best;
}

std::vector<Ray> randomRays(std::uint64_t key, int count, double spread) {
    base::RandomStream random(key);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 from(test::randomPoint(random, spread));
        const Vec3 to(test::randomPoint(random, spread));
        switch (i % 3) {
            case 0:
                rays.push_back({from, 0.0f, to - from, 1.0f});
                break;
            case 1:
                rays.push_back({from, 0.0f, Vec3(test::randomDirection(random)), kInf});
                break;
            default:
                rays.push_back({from, 0.25f, 0.5f * (to - from), 1.5f});
        }
    }
    return rays;
}

TEST(RayScene, agreesWithBruteForceOnRandomScenes) {
    // Rays that graze an edge or a limb may differ, as Embree works in float: a handful.
    int compared = 0;
    int different = 0;
    int hits = 0;
    for (std::uint64_t key = 1; key <= 6; ++key) {
        const scene::Scene scene = test::randomScene(key, 3, 12, key % 2 == 0 ? 6 : 0);
        const RayScene rays(scene, base::Executor(1));
        for (const Ray& ray : randomRays(100 + key, 4000, 1.6)) {
            const auto expected = bruteForce(scene, ray);
            const auto found = rays.closest(ray);
            ++compared;
            if (found.has_value() != expected.has_value() ||
                (found &&
                 (base::index(found->object) != expected->object || found->patch != expected->at.patch))) {
                ++different;
                continue;
            }
            if (!found) {
                continue;
            }
            ++hits;
            EXPECT_NEAR(static_cast<double>(found->t), expected->at.t, 2e-4 * (1.0 + expected->at.t));
            const Vec3d n =
                scene.objects[expected->object].surface->evaluate(expected->at.patch, expected->at.uv).normal;
            const double facing = glm::dot(n, Vec3d(ray.direction)) / glm::length(Vec3d(ray.direction));
            if (std::abs(facing) > 1e-3) {
                EXPECT_EQ(found->back, facing > 0.0);
            }
        }
    }
    EXPECT_GT(hits, compared / 5);
    EXPECT_LE(different, compared / 5000) << "of " << compared;
}

TEST(RayScene, occlusionAgreesWithClosestHitsAndBundlesWithSingleRays) {
    for (std::uint64_t key = 1; key <= 4; ++key) {
        const scene::Scene scene = test::randomScene(key, 4, 10, key > 2 ? 5 : 0);
        const RayScene rays(scene, base::Executor(1));
        const std::vector<Ray> bundle = randomRays(200 + key, 2000, 1.2);
        std::vector<std::uint8_t> blocked(bundle.size(), 7);
        rays.occluded(bundle, blocked);
        std::size_t count = 0;
        for (std::size_t i = 0; i < bundle.size(); ++i) {
            ASSERT_LE(blocked[i], 1);
            EXPECT_EQ(blocked[i] != 0, rays.isOccluded(bundle[i]));
            EXPECT_EQ(blocked[i] != 0, rays.closest(bundle[i]).has_value());
            count += blocked[i];
        }
        EXPECT_GT(count, bundle.size() / 10);
        EXPECT_LT(count, bundle.size() * 9 / 10);
    }
}

TEST(RayScene, bundlesOfEverySize) {
    const scene::Scene scene = test::randomScene(3, 4, 10, 3);
    const RayScene rays(scene, base::Executor(1));
    const std::vector<Ray> all = randomRays(300, 200, 1.2);
    for (const std::size_t size : {0u, 1u, 2u, 15u, 16u, 63u, 64u, 65u, 127u, 128u, 129u, 200u}) {
        std::vector<std::uint8_t> blocked(size, 7);
        rays.occluded(std::span(all.data(), size), blocked);
        for (std::size_t i = 0; i < size; ++i) {
            EXPECT_EQ(blocked[i] != 0, rays.isOccluded(all[i])) << size << ' ' << i;
        }
    }
}

TEST(RayScene, raysThatMakeNoSenseMeetNothingAndNeverAbort) {
    const scene::Scene scene = test::randomScene(4, 2, 10, 2);
    const RayScene rays(scene, base::Executor(1));
    const Vec3 o(0.1f, 0.2f, 0.3f);
    const Vec3 d(0.0f, 0.0f, 1.0f);
    const std::vector<Ray> bad{{{kNan, 0, 0}, 0.0f, d, 1.0f},
                               {{0, kInf, 0}, 0.0f, d, 1.0f},
                               {o, 0.0f, {0, kNan, 0}, 1.0f},
                               {o, 0.0f, {-kInf, 0, 0}, 1.0f},
                               {o, -1.0f, d, 1.0f},
                               {o, kNan, d, 1.0f},
                               {o, 0.0f, d, kNan},
                               {o, 1.0f, d, 0.5f},
                               {o, 0.0f, d, -kInf},
                               {o, -0.1f, d, -0.2f}};
    // Between them sound rays, which must be unharmed.
    const Ray free{{50, 50, 50}, 0.0f, {1, 0, 0}, 1.0f};
    std::vector<Ray> mixed;
    for (const Ray& ray : bad) {
        EXPECT_FALSE(rays.closest(ray).has_value());
        EXPECT_TRUE(rays.isOccluded(ray)) << "nothing is known to be free";
        mixed.push_back(ray);
        mixed.push_back(free);
    }
    std::vector<std::uint8_t> blocked(mixed.size(), 7);
    rays.occluded(mixed, blocked);
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        EXPECT_EQ(blocked[i], i % 2 == 0 ? 1 : 0);
    }
}

TEST(RayScene, extremeButFiniteRaysNeverAbort) {
    const scene::Scene scene = test::randomScene(5, 2, 10, 4);
    const RayScene rays(scene, base::Executor(1));
    const float big = std::numeric_limits<float>::max();
    const float tiny = std::numeric_limits<float>::denorm_min();
    std::vector<Ray> odd{{{0, 0, 0}, 0.0f, {0, 0, 0}, 1.0f},          {{0, 0, 0}, 0.0f, {0, 0, 0}, kInf},
                         {{big, big, big}, 0.0f, {-1, -1, -1}, kInf}, {{0, 0, 0}, 0.0f, {big, 0, 0}, 1.0f},
                         {{0, 0, 0}, 0.0f, {tiny, 0, 0}, kInf},       {{0, 0, 0}, 0.0f, {-0.0f, 1, 0}, big},
                         {{0, 0, 0}, 0.0f, {0, 0, 1}, 0.0f},          {{0, 0, 0}, 5.0f, {0, 0, 1}, 5.0f},
                         {{0, 0, 0}, kInf, {0, 0, 1}, kInf}};
    std::vector<std::uint8_t> blocked(odd.size(), 7);
    rays.occluded(odd, blocked);
    for (std::size_t i = 0; i < odd.size(); ++i) {
        EXPECT_LE(blocked[i], 1);
        if (const auto hit = rays.closest(odd[i])) {
            EXPECT_LT(base::index(hit->object), scene.objects.size());
        }
    }
}

TEST(RayScene, liftIsRelativeToTheSceneAndSparesTheOwnSurface) {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(0.5f));
    const Vec3d far(1000.0, -2000.0, 500.0);
    scene::addPolygons(scene, "floor", grey, scene::boxFaces(far, far + Vec3d(3.0, 0.0, 4.0), scene::kTop));
    scene::addPolygons(scene, "wall", grey,
                       scene::boxFaces(far, far + Vec3d(0.0, 12.0, 4.0), scene::kLeft, true));
    const RayScene rays(scene, base::Executor(1));
    EXPECT_NEAR(rays.lift(), rays::kLift * 13.0, 1e-12);
    base::RandomStream random(9);
    const Vec3d up(0, 1, 0);
    const Vec3d right(1, 0, 0);
    int free = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3d onFloor = far + Vec3d(3.0 * random.next(), 0.0, 4.0 * random.next());
        const Vec3d onWall = far + Vec3d(0.0, 12.0 * random.next(), 4.0 * random.next());
        const Ray ray = rays.segment(onFloor, up, onWall, right);
        const Vec3d lifted = onFloor + rays.lift() * up;
        EXPECT_LT(glm::distance(Vec3d(ray.origin), lifted), 3e-4);
        EXPECT_LT(glm::distance(Vec3d(ray.origin) + Vec3d(ray.direction), onWall + rays.lift() * right),
                  4e-4);
        free += rays.isOccluded(ray) ? 0 : 1;
        EXPECT_FALSE(rays.isOccluded(rays.halfLine(onFloor, up, up)));
    }
    // 2 km from the origin a float resolves 0.12 mm, which is as much as the lift of this scene.
    EXPECT_GT(free, 1980);
    const scene::Scene nothing;
    EXPECT_GT(RayScene(nothing, base::Executor(1)).lift(), 0.0);
}

TEST(RayScene, emptyScenesAndBlendedObjectsLetAllLightPass) {
    const scene::Scene nothing;
    EXPECT_FALSE(RayScene(nothing, base::Executor(1)).isOccluded({{0, 0, 0}, 0.0f, {0, 0, 1}, kInf}));
    scene::Scene scene;
    scene::addMaterial(scene, "glass", base::Rgb(0.5f));
    scene::addMaterial(scene, "wall", base::Rgb(0.5f));
    scene.materials[0].alphaMode = scene::AlphaMode::blend;
    scene::addPolygons(scene, "pane", 0, scene::boxFaces({-1, -1, 1}, {1, 1, 1}, scene::kNear));
    scene.objects.push_back({"ball", std::make_shared<surface::Sphere>(Vec3d(0, 0, 2), 0.5), 0});
    scene::addPolygons(scene, "wall", 1, scene::boxFaces({-1, -1, 4}, {1, 1, 4}, scene::kNear));
    const RayScene rays(scene, base::Executor(1));
    EXPECT_FALSE(rays.isOccluded({{0, 0, 0}, 0.0f, {0, 0, 1}, 3.9f}));
    const auto hit = rays.closest({{0, 0, 0}, 0.0f, {0, 0, 1}, kInf});
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(base::index(hit->object), 2u);
    EXPECT_FLOAT_EQ(hit->t, 4.0f);
}

}  // namespace
}  // namespace fluxwalk
