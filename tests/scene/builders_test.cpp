#include "core/scene/builders.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/rays/ray_scene.h"
#include "core/scene/polygons.h"
#include "core/surface/region.h"

namespace fluxwalk {

namespace {

using base::Vec3d;

double areaOf(const scene::Object& object) {
    double sum = 0.0;
    for (std::uint32_t patch = 0; patch < object.surface->patchCount(); ++patch) {
        sum += object.surface->area(patch, surface::wholePatch(object.surface->domain(patch)));
    }
    return sum;
}

double areaOf(const scene::Scene& scene, std::string_view name) {
    for (const scene::Object& object : scene.objects) {
        if (object.name == name) {
            return areaOf(object);
        }
    }
    return -1.0;
}

}  // namespace

TEST(BuiltInScenes, eachHasItsNameACameraAndLight) {
    std::set<std::string_view> names;
    for (const scene::BuiltInScene& entry : scene::builtInScenes()) {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        EXPECT_FALSE(entry.description.empty());
        const auto built = scene::buildScene(entry.name);
        ASSERT_TRUE(built.has_value());
        EXPECT_EQ(built->name, entry.name);
        EXPECT_TRUE(built->hasLight()) << entry.name;
        ASSERT_FALSE(built->cameras.empty()) << entry.name;
        for (const scene::Camera& camera : built->cameras) {
            EXPECT_NEAR(glm::length(camera.forward), 1.0, 1e-12);
            EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0, 1e-12);
        }
        for (const scene::Object& object : built->objects) {
            EXPECT_LT(object.material, built->materials.size());
            EXPECT_GT(areaOf(object), 0.0) << entry.name << ": " << object.name;
        }
    }
    EXPECT_FALSE(scene::buildScene("no-such-scene").has_value());
}

// ALGORITHMS 3.10: areas of the published geometry in mm2.
TEST(BuiltInScenes, cornellBoxHasThePublishedAreas) {
    const scene::Scene box = *scene::buildScene("cornell-box-unit");
    const std::map<std::string_view, double> expected{{"floor", 308231.0},     {"ceiling", 297265.2},
                                                      {"back wall", 303376.6}, {"right wall", 306889.0},
                                                      {"left wall", 306904.5}, {"lamp", 13650.0}};
    for (const auto& [name, area] : expected) {
        EXPECT_NEAR(areaOf(box, name) * 1e6, area, .2) << name;
    }
    const auto topOf = [&](std::size_t object) {
        const surface::Surface& surface = *box.objects[object].surface;
        EXPECT_EQ(surface.patchCount(), 5u);
        EXPECT_NEAR(surface.evaluate(0, {.5, .5}).normal.y, 1.0, 1e-12);
        return surface.area(0, surface::wholePatch(surface::PatchDomain::quad)) * 1e6;
    };
    EXPECT_NEAR(topOf(5), 27633.0, .2);
    EXPECT_NEAR(topOf(6), 27626.5, .2);
    EXPECT_EQ(box.objects[1].surface->patchCount(), 8u) << "rectangles around the lamp";
    EXPECT_EQ(box.objects[4].surface->patchCount(), 2u) << "the twisted wall";
    for (std::size_t i = 0; i < 5; ++i) {
        const surface::Surface& wall = *box.objects[i].surface;
        const surface::SurfacePoint point = wall.evaluate(0, {.4, .4});
        EXPECT_GT(glm::dot(point.normal, Vec3d(.278, .273, .28) - point.position), 0.0)
            << box.objects[i].name;
    }
}

TEST(BuiltInScenes, litCornellBoxHas800Lumens) {
    const scene::Scene box = *scene::buildScene("cornell-box");
    const base::Rgb& m = box.materials[box.objects[7].material].emission;
    const double flux =
        areaOf(box.objects[7]) * (.2126 * static_cast<double>(m.r) + .7152 * static_cast<double>(m.g) +
                                  .0722 * static_cast<double>(m.b));
    EXPECT_NEAR(flux, 800.0, .01);
}

// No ray that starts inside a closed scene may leave it, and none may meet the outside of the shell.
TEST(BuiltInScenes, closedScenesAreClosed) {
    const base::Executor executor(1);
    for (const char* name : {"furnace", "furnace-planar", "cie-5.8", "two-rooms", "lamp-box", "blobs"}) {
        const scene::Scene closed = *scene::buildScene(name);
        const rays::RayScene rays(closed, executor);
        for (const scene::Camera& camera : closed.cameras) {
            base::RandomStream random(7);
            for (int i = 0; i < 5000; ++i) {
                const double z = 2.0 * random.next() - 1.0;
                const double phi = 6.283185307179586 * random.next();
                const double r = std::sqrt(1.0 - z * z);
                const auto hit = rays.closest(
                    rays.halfLine(camera.position, Vec3d(0.0), {r * std::cos(phi), r * std::sin(phi), z}));
                ASSERT_TRUE(hit.has_value()) << name << ", " << camera.name;
                EXPECT_FALSE(hit->back) << name << ", " << closed.objects[base::index(hit->object)].name;
            }
        }
    }
}

// A picture through each camera shows the scene: most of the middle of the view meets a front.
// The vault is a whole cylinder, the window a box of disks: seen from inside, nothing shows its back but
// thin things that stand or hang free.
TEST(BuiltInScenes, galleryIsClosed) {
    const base::Executor executor(1);
    const scene::Scene gallery = *scene::buildScene("gallery");
    const rays::RayScene rays(gallery, executor);
    const std::set<std::string_view> open{"lampshade", "bowl", "cord"};
    for (const scene::Camera& camera : gallery.cameras) {
        base::RandomStream random(11);
        for (int i = 0; i < 20000; ++i) {
            const double z = 2.0 * random.next() - 1.0;
            const double phi = 6.283185307179586 * random.next();
            const double r = std::sqrt(1.0 - z * z);
            const auto hit = rays.closest(
                rays.halfLine(camera.position, Vec3d(0.0), {r * std::cos(phi), r * std::sin(phi), z}));
            ASSERT_TRUE(hit.has_value()) << camera.name;
            const std::string& name = gallery.objects[base::index(hit->object)].name;
            EXPECT_TRUE(!hit->back || open.contains(name)) << camera.name << ", " << name;
        }
    }
}

TEST(BuiltInScenes, camerasSeeTheScene) {
    const base::Executor executor(1);
    for (const scene::BuiltInScene& entry : scene::builtInScenes()) {
        const scene::Scene scene = entry.build();
        const rays::RayScene rays(scene, executor);
        for (const scene::Camera& camera : scene.cameras) {
            const double half = std::tan(.5 * camera.verticalFov);
            const Vec3d right = glm::cross(camera.forward, camera.up);
            int seen = 0;
            for (int y = 0; y < 20; ++y) {
                for (int x = 0; x < 20; ++x) {
                    const Vec3d direction =
                        camera.forward + half * ((x - 9.5) / 10.0 * right + (y - 9.5) / 10.0 * camera.up);
                    seen += rays.closest(rays.halfLine(camera.position, Vec3d(0.0), direction)) ? 1 : 0;
                }
            }
            EXPECT_GT(seen, 40) << entry.name << ", " << camera.name;
        }
    }
}

TEST(Polygons, boxFacesLookOutwardsOrInwards) {
    const Vec3d lower(-1, 2, 3);
    const Vec3d upper(1, 5, 4);
    for (const bool inwards : {false, true}) {
        const scene::Quads faces = scene::boxFaces(lower, upper, scene::kAllFaces, inwards);
        ASSERT_EQ(faces.size(), 6u);
        for (const scene::Quad& q : faces) {
            const Vec3d normal = glm::cross(q[1] - q[0], q[2] - q[0]);
            const Vec3d middle = .25 * (q[0] + q[1] + q[2] + q[3]);
            EXPECT_EQ(glm::dot(normal, .5 * (lower + upper) - middle) > 0.0, inwards);
        }
    }
}

TEST(Polygons, gridCellsTileTheQuad) {
    scene::Scene scene;
    scene::addMaterial(scene, "m", base::Rgb(.5f));
    scene::addPolygons(scene, "grid", 0,
                       scene::gridOf({Vec3d(0, 0, 0), Vec3d(0, 0, 3), Vec3d(2, 0, 3), Vec3d(2, 0, 0)}, 6, 4));
    EXPECT_EQ(scene.objects[0].surface->patchCount(), 24u);
    EXPECT_NEAR(areaOf(scene.objects[0]), 6.0, 1e-12);
}

}  // namespace fluxwalk
