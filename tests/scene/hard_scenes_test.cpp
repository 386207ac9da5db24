#include "tests/support/hard_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/rays/ray_scene.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/region.h"

namespace fluxwalk {
namespace {

using base::Vec3d;
using scene::Scene;

std::size_t patchesOf(const Scene& scene) {
    std::size_t sum = 0;
    for (const scene::Object& object : scene.objects) {
        sum += object.surface->patchCount();
    }
    return sum;
}

void expectNothingDropped(const Scene& scene) {
    EXPECT_TRUE(scene.hasLight());
    for (const scene::Object& object : scene.objects) {
        const auto* mesh = dynamic_cast<const surface::PolygonMesh*>(object.surface.get());
        ASSERT_NE(mesh, nullptr);
        EXPECT_EQ(mesh->droppedTriangleCount(), 0u);
        for (std::uint32_t p = 0; p < mesh->patchCount(); ++p) {
            const double area = mesh->area(p, surface::wholePatch(mesh->domain(p)));
            EXPECT_TRUE(std::isfinite(area) && area > 0.0);
        }
    }
}

TEST(HardScenes, onePolygon) {
    const Scene scene = test::buildOnePolygon();
    EXPECT_EQ(patchesOf(scene), 1u);
    expectNothingDropped(scene);
}

TEST(HardScenes, coincidentPolygonsAreBitwiseEqual) {
    const Scene scene = test::buildCoincident(5000);
    ASSERT_EQ(scene.objects.size(), 5002u);
    EXPECT_EQ(patchesOf(scene), 6u + 1u + 5000u);
    const auto first = scene.objects[2].surface->triangles();
    for (std::size_t i = 3; i < scene.objects.size(); ++i) {
        const auto other = scene.objects[i].surface->triangles();
        ASSERT_TRUE(std::equal(first.positions.begin(), first.positions.end(), other.positions.begin(),
                               other.positions.end()));
    }
    expectNothingDropped(scene);
}

TEST(HardScenes, hugePolygonIsAMillionTimesWider) {
    const Scene scene = test::buildHugePolygon();
    expectNothingDropped(scene);
    const Vec3d room = scene.objects[0].surface->bounds().size();
    const Vec3d table = scene.objects[2].surface->bounds().size();
    EXPECT_GE(room.x / table.x, 1e6);
    EXPECT_EQ(scene.objects[1].surface->bounds().size().x, 1.0) << "the lamp is exact in float";
}

TEST(HardScenes, farAwayKeepsItsSizes) {
    const Scene scene = test::buildFarAway();
    expectNothingDropped(scene);
    EXPECT_EQ(scene.bounds().lower, Vec3d(1e6));
    EXPECT_EQ(scene.bounds().size(), Vec3d(4.0, 3.0, 4.0));
    EXPECT_EQ(scene.objects[1].surface->bounds().size(), Vec3d(1.0, 0.0, 1.0));
    EXPECT_EQ(scene.objects[2].surface->bounds().size(), Vec3d(1.0, 0.75, 2.0));
}

TEST(HardScenes, cloudsAreSmallTrianglesInAClosedRoom) {
    for (const unsigned count : {1000u, 1025u, 100'000u}) {
        const Scene scene = test::buildCloud(count, 7);
        expectNothingDropped(scene);
        EXPECT_EQ(patchesOf(scene), 6u + count);
        EXPECT_EQ(scene.bounds().size(), Vec3d(10.0));
        double glowing = 0.0;
        double all = 0.0;
        for (std::size_t i = 1; i < scene.objects.size(); ++i) {
            const auto* mesh = dynamic_cast<const surface::PolygonMesh*>(scene.objects[i].surface.get());
            for (std::uint32_t p = 0; p < mesh->patchCount(); ++p) {
                const auto c = mesh->corners(p);
                for (std::size_t k = 0; k < 3; ++k) {
                    const double edge = glm::distance(c[k], c[(k + 1) % 3]);
                    EXPECT_GT(edge, 0.02);
                    EXPECT_LT(edge, 0.2);
                }
                const double area = mesh->area(p, surface::wholePatch(mesh->domain(p)));
                all += area;
                glowing += scene.materials[scene.objects[i].material].isEmissive() ? area : 0.0;
            }
        }
        EXPECT_NEAR(glowing / all, 0.1, 0.03);
    }
    const auto a = test::buildCloud(1000, 7).objects[3].surface->bounds().lower;
    EXPECT_EQ(a, test::buildCloud(1000, 7).objects[3].surface->bounds().lower);
    EXPECT_NE(a, test::buildCloud(1000, 8).objects[3].surface->bounds().lower);
}

}  // namespace
}  // namespace fluxwalk
