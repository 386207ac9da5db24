#include "core/display/interpolate.h"

#include <gtest/gtest.h>

#include "tests/display/display_scenes.h"

namespace fluxwalk::display {
namespace {

double slope(const Vec3d& p) {
    return 2.0 + 0.7 * p.x + 0.4 * p.y * p.y + 0.3 * p.z;
}

// The value in the triangle, of all of the mesh, in whose plane and inside of which the point lies deepest.
Rgb searchAll(const scene::LitMesh& mesh, const Vec3d& p) {
    double deepest = -1e30;
    Rgb result(0.0f);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const std::array<std::uint32_t, 3> i{mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]};
        const Vec3d a(mesh.positions[i[0]]);
        const Vec3d ab = Vec3d(mesh.positions[i[1]]) - a;
        const Vec3d ac = Vec3d(mesh.positions[i[2]]) - a;
        const Vec3d n = glm::cross(ab, ac);
        const double v = glm::dot(glm::cross(p - a, ac), n) / glm::dot(n, n);
        const double w = glm::dot(glm::cross(ab, p - a), n) / glm::dot(n, n);
        const double off = std::abs(glm::dot(p - a, n)) / glm::length(n);
        const double depth = std::min({1.0 - v - w, v, w}) - 1e6 * std::max(0.0, off - 1e-5);
        if (depth > deepest) {
            deepest = depth;
            result = Rgb((1.0 - v - w) * Vec3d(mesh.irradiance[i[0]]) + v * Vec3d(mesh.irradiance[i[1]]) +
                         w * Vec3d(mesh.irradiance[i[2]]));
        }
    }
    return result;
}

TEST(DisplayLookup, FindsTheTriangleThatIsShown) {
    const auto box = makeBox({1.0f, 2.0f, 3.0f});
    const auto triangles = makeTriangleFloor(4.0f);
    for (const surface::Surface* surface : {static_cast<const surface::Surface*>(box.get()),
                                            static_cast<const surface::Surface*>(triangles.get())}) {
        const auto leaves = makeLeaves(*surface, slope, SplitRandomly{4, 5, 0.6}, 2);
        const DisplayMeshes meshes = buildDisplayMeshes(PatchTopology(*surface), 0, 0, leaves, MeshOptions{});
        const DisplayLookup lookup(*surface, meshes);
        base::RandomStream random(2);
        for (int i = 0; i < 400; ++i) {
            const auto patch = static_cast<std::uint32_t>(random.next() * surface->patchCount());
            const Vec2d uv =
                surface::mapToRegion(surface::wholePatch(surface->domain(patch)), random.next2()).uv;
            const auto found = lookup.irradiance(patch, false, uv);
            ASSERT_TRUE(found.has_value());
            const Rgb expected = searchAll(*meshes.meshes[0], surface->evaluate(patch, uv).position);
            EXPECT_NEAR(found->r, expected.r, 1e-4f * expected.r);
            EXPECT_NEAR(found->b, expected.b, 1e-4f * expected.b);
        }
    }
}

TEST(DisplayLookup, ReadsCurvedSurfacesThroughTheirWarpedQuarters) {
    const surface::Sphere sphere(Vec3d(0.0), 1.0);
    const auto leaves = makeLeaves(sphere, slope, SplitUniformly{5}, 8);
    const DisplayMeshes meshes = buildDisplayMeshes(PatchTopology(sphere), 0, 0, leaves, MeshOptions{});
    const DisplayLookup lookup(sphere, meshes);
    base::RandomStream random(2);
    for (int i = 0; i < 2000; ++i) {
        const auto patch = static_cast<std::uint32_t>(random.next() * 8.0);
        const Vec2d uv =
            surface::mapToRegion(surface::wholePatch(surface::PatchDomain::triangle), random.next2()).uv;
        const double expected = slope(sphere.evaluate(patch, uv).position);
        EXPECT_NEAR(static_cast<double>(lookup.irradiance(patch, false, uv)->r), expected, 0.002 * expected);
    }
}

TEST(DisplayLookup, KnowsWhichSidesAreShown) {
    const auto floor = makeFloor(2, 2.0f);
    auto leaves = makeLeaves(*floor, slope, SplitUniformly{1}, 1);
    // Patch 3 is not shown, patch 0 only from behind.
    std::erase_if(leaves, [](const Leaf& leaf) { return leaf.patch == 3; });
    for (Leaf& leaf : leaves) {
        leaf.back = leaf.patch == 0;
    }
    const DisplayMeshes meshes = buildDisplayMeshes(PatchTopology(*floor), 0, 0, leaves, MeshOptions{});
    const DisplayLookup lookup(*floor, meshes);
    const Vec2d middle(0.5);
    EXPECT_TRUE(lookup.irradiance(0, true, middle).has_value());
    EXPECT_FALSE(lookup.irradiance(0, false, middle).has_value());
    EXPECT_TRUE(lookup.irradiance(1, false, middle).has_value());
    EXPECT_FALSE(lookup.irradiance(1, true, middle).has_value());
    EXPECT_FALSE(lookup.irradiance(3, false, middle).has_value());
    EXPECT_FALSE(lookup.irradiance(3, true, middle).has_value());
}

}  // namespace
}  // namespace fluxwalk::display
