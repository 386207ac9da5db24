#include <gtest/gtest.h>

#include "core/rays/ray_scene.h"
#include "core/scene/polygons.h"
#include "tests/support/random_scenes.h"
#include "tests/surface/projectables.h"

namespace fluxwalk {

namespace {

using base::Vec3d;

}  // namespace

// Rays from outside, aimed within 1e-10 to 1e-7 of the edges and vertices of the subdivision: none passes.
TEST(ProjectedRays, noRayPassesBetweenElements) {
    const test::ProjectedUnion blobs;
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.objects.push_back({"blobs", std::make_shared<surface::ProjectedSurface>(blobs.surface), 0});
    const rays::RayScene rays(scene, base::Executor(1));
    base::RandomStream random(1);
    const double size = blobs.object->bounds().diagonal();
    std::vector<std::pair<std::uint32_t, surface::Region>> elements;
    test::forElements(blobs.surface, 2, [&](auto patch, const auto& r) { elements.emplace_back(patch, r); });
    for (int i = 0; i < 100000; ++i) {
        const auto& [patch, region] = elements[static_cast<std::size_t>(i) % elements.size()];
        const auto side = static_cast<std::size_t>(4.0 * random.next());
        const double s = i % 4 == 0 ? 0.0 : random.next();
        const base::Vec2d uv = (1.0 - s) * region.corners[side] + s * region.corners[(side + 1) % 4];
        const surface::SurfacePoint p = blobs.surface.evaluate(patch, uv);
        const double off = std::pow(10.0, -10.0 + 3.0 * random.next());
        const Vec3d target = p.position + off * test::randomDirection(random);
        // Within 80 degrees of the normal: the ray must meet something at the target or before it.
        Vec3d back = test::randomDirection(random);
        back = glm::normalize(back + (glm::dot(back, p.normal) < 0.0 ? 1.2 : .2) * p.normal);
        if (glm::dot(back, p.normal) < .17) {
            back = p.normal;
        }
        const Vec3d from = target + 2.0 * size * back;
        const auto hit = rays.closest({base::Vec3(from), 0.0f, base::Vec3(-2.0 * size * back), INFINITY});
        ASSERT_TRUE(hit.has_value()) << i;
        ASSERT_FALSE(hit->back) << i;
        ASSERT_LT(hit->t, 1.0f + 1e-5f) << i;
    }
}

// What rays see of a surface they see at the place that its parameterisation names.
TEST(ProjectedRays, hitsNameThePatchTheyLieOn) {
    const test::ProjectedTorus torus;
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.objects.push_back({"torus", std::make_shared<surface::ProjectedSurface>(torus.surface), 0});
    const rays::RayScene rays(scene, base::Executor(1));
    base::RandomStream random(2);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3d from = 3.0 * test::randomDirection(random);
        const Vec3d along = 1.2 * test::randomDirection(random) - from;
        const auto hit = rays.closest({base::Vec3(from), 0.0f, base::Vec3(along), INFINITY});
        if (hit) {
            ++hits;
            const Vec3d met = from + static_cast<double>(hit->t) * along;
            const surface::SurfacePoint p =
                torus.surface.evaluate(hit->patch, torus.surface.locate(hit->patch, met));
            ASSERT_LT(glm::distance(p.position, met), 2e-6) << i;
            ASSERT_FALSE(hit->back);
        }
    }
    EXPECT_GT(hits, 1000);
}

}  // namespace fluxwalk
