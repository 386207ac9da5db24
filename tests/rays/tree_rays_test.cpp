#include "core/rays/tree_rays.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/rays/ray_scene.h"
#include "core/scene/builders.h"
#include "tests/support/random_scenes.h"

namespace fluxwalk {
namespace {

using base::Executor;
using base::Vec3;
using base::Vec3d;
using rays::Ray;
using rays::RayEngine;
using rays::RayScene;
using rays::TreeBuilder;

constexpr std::array kBuilders = {TreeBuilder::sah, TreeBuilder::hybrid, TreeBuilder::embree};

// Segments between points in the scene's box, half-lines from points about it, and lines along the axes.
std::vector<Ray> randomRays(const scene::Scene& scene, std::uint64_t key, std::size_t count) {
    base::RandomStream random(key);
    const base::Box box = scene.bounds();
    const auto point = [&](double reach) {
        const double x = random.next() - 0.5;
        const double y = random.next() - 0.5;
        return box.center() + reach * Vec3d(x, y, random.next() - 0.5) * box.size();
    };
    std::vector<Ray> rays(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d from = point(1.0);
        const Vec3d to = point(1.0);
        switch (i % 4) {
            case 0:
                rays[i] = {Vec3(from), 0.0f, Vec3(test::randomDirection(random)), INFINITY};
                rays[i].origin = Vec3(point(2.0));
                break;
            case 1: {
                Vec3 direction(0.0f);
                direction[static_cast<int>(i / 4 % 3)] = i % 8 < 4 ? 1.0f : -1.0f;
                rays[i] = {Vec3(from), 0.0f, direction, 0.3f * static_cast<float>(box.diagonal())};
                break;
            }
            case 2:  // short ones
                rays[i] = {Vec3(from), 0.0f, Vec3(0.05 * (to - from)), 1.0f};
                break;
            default:
                rays[i] = {Vec3(from), 0.1f, Vec3(to - from), 0.9f};
        }
    }
    return rays;
}

// Whether a ray passes an edge, a limb or an end within rounding: Embree itself changes its mind when the ray
// is moved by a few steps of float.
bool isMarginal(const RayScene& embree, const Ray& ray, double extent, base::RandomStream& random) {
    int blocked = 0;
    constexpr int kMoves = 200;
    for (int i = 0; i < kMoves; ++i) {
        Ray moved = ray;
        moved.origin += Vec3(0x1p-21 * extent * test::randomDirection(random));
        moved.direction += 0x1p-22f * glm::length(ray.direction) * Vec3(test::randomDirection(random));
        blocked += embree.isOccluded(moved) ? 1 : 0;
    }
    return blocked > 0 && blocked < kMoves;
}

void compareWithEmbree(const scene::Scene& scene, std::size_t count) {
    const RayScene embree(scene, Executor(2));
    const std::vector<Ray> rays = randomRays(scene, 21, count);
    std::vector<std::uint8_t> expected(count);
    embree.occluded(rays, expected);
    std::size_t hits = 0;
    for (const std::uint8_t blocked : expected) {
        hits += blocked;
    }
    EXPECT_GT(hits, count / 20);
    EXPECT_LT(hits, count * 19 / 20);
    base::RandomStream random(22);
    for (const TreeBuilder builder : kBuilders) {
        const RayScene own(scene, Executor(2), RayEngine::clusters, builder);
        EXPECT_EQ(own.patchTree()->builder, builder);
        std::vector<std::uint8_t> blocked(count, 7);
        own.occluded(rays, blocked);
        std::size_t different = 0;
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_LE(blocked[i], 1);
            if (blocked[i] == expected[i]) {
                continue;
            }
            ++different;
            EXPECT_TRUE(isMarginal(embree, rays[i], scene.bounds().diagonal(), random))
                << "ray " << i << " of builder " << static_cast<int>(builder) << ", Embree "
                << static_cast<int>(expected[i]);
        }
        testing::Test::RecordProperty("different" + std::to_string(static_cast<int>(builder)),
                                      static_cast<int>(different));
        EXPECT_LE(different, count / 20000) << static_cast<int>(builder);
    }
}

TEST(TreeRays, agreeWithEmbreeInTheGallery) {
    compareWithEmbree(scene::buildGallery(), 100000);
}

TEST(TreeRays, agreeWithEmbreeInTheCornellBox) {
    compareWithEmbree(scene::buildCornellBox(base::Rgb(100.0f)), 100000);
}

TEST(TreeRays, agreeWithEmbreeInAPolygonCloud) {
    const scene::Scene cloud = test::randomScene(23, 2, 10000, 0, 0.05);
    EXPECT_FALSE(RayScene(cloud, Executor(2), RayEngine::clusters, TreeBuilder::hybrid)
                     .patchTree()
                     ->tree.grids()
                     .empty())
        << "the hybrid's grids are to be walked";
    compareWithEmbree(cloud, 100000);
}

TEST(TreeRays, agreeWithEmbreeAmongPolygonsAndEllipsoids) {
    compareWithEmbree(test::randomScene(24, 3, 40, 20, 0.4), 20000);
}

TEST(TreeRays, agreeWithEmbreeFarFromTheOrigin) {
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(0.5f), base::Rgb(0.0f));
    base::RandomStream random(25);
    scene::Quads quads;
    for (int i = 0; i < 3000; ++i) {
        scene::Quad quad = test::randomQuad(random, 500.0, 60.0);
        for (Vec3d& corner : quad) {
            corner += Vec3d(1e6, -1e6, 1e6);
        }
        quads.push_back(quad);
    }
    scene::addPolygons(scene, "quads", grey, quads);
    // Float steps are 1/16 m here: moved rays see what a rounded end does.
    compareWithEmbree(scene, 20000);
}

TEST(TreeRays, noRaySlipsBetweenNeighbours) {
    // A height field, and rays straight at its inner vertices and edges.
    constexpr int kSide = 24;
    base::RandomStream random(26);
    std::vector<std::vector<Vec3d>> points(kSide + 1, std::vector<Vec3d>(kSide + 1));
    for (int i = 0; i <= kSide; ++i) {
        for (int j = 0; j <= kSide; ++j) {
            points[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                Vec3d(Vec3(Vec3d(i + 0.3 * random.next(), random.next(), j + 0.3 * random.next()) / 7.0));
        }
    }
    surface::TriangleSoup soup;
    for (const auto& row : points) {
        for (const Vec3d& point : row) {
            soup.positions.emplace_back(point);
        }
    }
    for (std::uint32_t i = 0; i < kSide; ++i) {
        for (std::uint32_t j = 0; j < kSide; ++j) {
            const std::uint32_t a = i * (kSide + 1) + j;
            soup.triangles.push_back({a, a + 1, a + kSide + 1});
            soup.triangles.push_back({a + 1, a + kSide + 2, a + kSide + 1});
        }
    }
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(0.5f), base::Rgb(0.0f));
    scene.objects.push_back({"field", std::make_shared<surface::PolygonMesh>(std::move(soup)), grey});
    for (const TreeBuilder builder : kBuilders) {
        const RayScene rays(scene, Executor(1), RayEngine::clusters, builder);
        for (std::size_t i = 1; i < kSide; ++i) {
            for (std::size_t j = 1; j < kSide; ++j) {
                for (const double part : {0.0, 0.25, 0.5}) {
                    const Vec3 target(points[i][j] + part * (points[i + 1][j] - points[i][j]));
                    const Vec3 above = target + Vec3(0.0f, 4.0f, 0.0f);
                    const Vec3 aside = target + Vec3(0.3f, 3.0f, -0.7f);
                    EXPECT_TRUE(rays.isOccluded({above, 0.0f, Vec3(0.0f, -1.0f, 0.0f), 8.0f}));
                    EXPECT_TRUE(rays.isOccluded({aside, 0.0f, target - aside, 2.0f}));
                }
            }
        }
    }
}

TEST(TreeRays, senselessRaysAreOccludedAndEmptyScenesFree) {
    const scene::Scene scene = scene::buildCornellBox(base::Rgb(1.0f));
    const RayScene rays(scene, Executor(1), RayEngine::clusters);
    const float nan = std::nanf("");
    EXPECT_TRUE(rays.isOccluded({Vec3(nan), 0.0f, Vec3(1.0f), 1.0f}));
    EXPECT_TRUE(rays.isOccluded({Vec3(0.0f), 0.0f, Vec3(0.0f, nan, 0.0f), 1.0f}));
    EXPECT_TRUE(rays.isOccluded({Vec3(0.0f), -1.0f, Vec3(1.0f), 1.0f}));
    EXPECT_TRUE(rays.isOccluded({Vec3(0.0f), 0.0f, Vec3(1.0f), nan}));
    EXPECT_TRUE(rays.isOccluded({Vec3(0.0f), 0.0f, Vec3(INFINITY), 1.0f}));
    EXPECT_FALSE(rays.isOccluded({Vec3(0.3f), 0.0f, Vec3(0.0f), 1.0f})) << "no direction";
    const scene::Scene nothing;
    EXPECT_FALSE(RayScene(nothing, Executor(1), RayEngine::clusters)
                     .isOccluded({Vec3(0.0f), 0.0f, Vec3(1.0f), INFINITY}));
}

}  // namespace
}  // namespace fluxwalk
