// Curved objects stop rays as what they are, not as a tessellation.
#include <gtest/gtest.h>

#include "core/rays/ray_scene.h"
#include "core/scene/polygons.h"
#include "tests/support/random_scenes.h"
#include "tests/surface/curved_shapes.h"

namespace fluxwalk {
namespace {

using rays::Ray;
using rays::RayScene;
using test::CurvedShape;
using test::Vec2d;
using test::Vec3d;

// Not inlined: g++ 12's vectoriser leaves out the rounding where it sees a double become a float and a double
// again, and a ray that is not rounded grazes elsewhere.
[[gnu::noinline]] bool isMet(const surface::Surface& shape, const Ray& ray) {
    return shape.intersect(Vec3d(ray.origin), Vec3d(ray.direction), 0.0, 1.0).has_value();
}

class CurvedOccluders : public testing::TestWithParam<CurvedShape> {};

INSTANTIATE_TEST_SUITE_P(All, CurvedOccluders, testing::ValuesIn(test::curvedShapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST_P(CurvedOccluders, StopRaysAtTheirSurface) {
    base::RandomStream random(1);
    int blocked = 0;
    for (const test::Placed& placed : test::placements(GetParam())) {
        scene::Scene scene;
        const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(.5f), base::Rgb(1.0f));
        scene.objects.push_back({"shape", placed.surface, grey});
        const RayScene rays(scene, base::Executor(1));
        const double size = placed.surface->bounds().diagonal();
        for (int i = 0; i < 300; ++i) {
            const std::uint32_t patch = test::randomPatch(*placed.surface, random);
            const auto whole = surface::wholePatch(placed.surface->domain(patch));
            const surface::SurfacePoint p =
                placed.surface->evaluate(patch, surface::mapToRegion(whole, .05 + .9 * random.next2()).uv);
            // From just above the surface to just below it, and back.
            const Vec3d step = 1e-4 * size * p.normal;
            const Ray down{base::Vec3(p.position + step), 0.0f, base::Vec3(-2.0 * step), 1.0f};
            const auto hit = rays.closest(down);
            ASSERT_TRUE(hit.has_value()) << placed.name;
            EXPECT_EQ(base::index(hit->object), 0u);
            EXPECT_EQ(hit->patch, patch) << placed.name;
            EXPECT_FALSE(hit->back) << placed.name;
            EXPECT_NEAR(hit->t, .5f, .02f) << placed.name;
            EXPECT_TRUE(rays.isOccluded(down)) << placed.name;
            const Ray up{base::Vec3(p.position - step), 0.0f, base::Vec3(2.0 * step), 1.0f};
            EXPECT_TRUE(rays.closest(up)->back) << placed.name;
            // A ray that starts and ends on the front side of one point is free, though a chord would not be.
            const Ray away{base::Vec3(p.position + .1 * step), 0.0f, base::Vec3(step), 1.0f};
            EXPECT_FALSE(rays.isOccluded(away)) << placed.name;
            // Across the scene: as the surface itself says.
            const Vec3d from = placed.surface->bounds().center() + test::randomPoint(random, size);
            const Ray across{base::Vec3(from), 0.0f, base::Vec3(1.5 * (p.position - from)), 1.0f};
            ASSERT_EQ(rays.isOccluded(across), isMet(*placed.surface, across)) << placed.name;
            blocked += rays.isOccluded(across) ? 1 : 0;
        }
    }
    EXPECT_GT(blocked, 2900);
}

}  // namespace
}  // namespace fluxwalk
