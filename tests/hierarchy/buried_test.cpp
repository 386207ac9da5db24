#include "core/hierarchy/buried.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/hierarchy/closed_mesh.h"
#include "core/reference/path_tracer.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"

namespace fluxwalk {
namespace {

using base::Executor;
using base::Rgb;
using base::Vec3d;
using hierarchy::ReachedSides;
using scene::addPolygons;
using scene::boxFaces;
using scene::join;
using scene::Quads;
using scene::Scene;

ReachedSides reach(const Scene& scene, unsigned threads = 1) {
    const Executor executor(threads);
    const rays::RayScene rays(scene, executor);
    return hierarchy::findReachedSides(scene, rays, executor, 1);
}

const surface::Surface& lastSurface(const Scene& scene) {
    return *scene.objects.back().surface;
}

/// Object 0: a closed room with walls of 10 cm, made of boxes; 1: its lamp.
Scene buildRoom() {
    Scene scene;
    const std::uint32_t wall = addMaterial(scene, "wall", Rgb(0.5f));
    const std::uint32_t lamp = addMaterial(scene, "lamp", Rgb(0.5f), Rgb(1000.0f));
    addPolygons(
        scene, "shell", wall,
        join({boxFaces({-0.1, -0.1, -0.1}, {4.1, 0.0, 4.1}), boxFaces({-0.1, 3.0, -0.1}, {4.1, 3.1, 4.1}),
              boxFaces({-0.1, 0.0, -0.1}, {0.0, 3.0, 4.1}), boxFaces({4.0, 0.0, -0.1}, {4.1, 3.0, 4.1}),
              boxFaces({0.0, 0.0, -0.1}, {4.0, 3.0, 0.0}), boxFaces({0.0, 0.0, 4.0}, {4.0, 3.0, 4.1})}));
    addPolygons(scene, "lamp", lamp, boxFaces({1.5, 2.5, 1.5}, {2.5, 2.5, 2.5}, scene::kBottom));
    return scene;
}

TEST(Buried, facesInContactAndOutsideTakeNoPart) {
    Scene scene = buildRoom();
    addPolygons(scene, "box", 0, boxFaces({1, 0, 1}, {2, 0.75, 2}));
    const ReachedSides reached = reach(scene);
    // Of each wall's six faces the room sees one.
    constexpr std::array<std::uint32_t, 6> kSeen{3, 2, 1, 0, 5, 4};
    for (std::uint32_t patch = 0; patch < 36; ++patch) {
        const bool isSeen = patch % 6 == kSeen[patch / 6];
        EXPECT_EQ(reached.isReached(0, patch, false), isSeen) << patch;
        EXPECT_FALSE(reached.isReached(0, patch, true)) << patch;
    }
    for (std::uint32_t patch = 0; patch < 6; ++patch) {
        EXPECT_EQ(reached.isReached(2, patch, false), patch != 2) << patch;
    }
    EXPECT_FALSE(reached.isOpen);
}

TEST(Buried, aGapOfAFewCentimetresCounts) {
    Scene scene = buildRoom();
    // The box hangs over the rim of a pedestal that otherwise hides its bottom.
    for (const double over : {0.0, 0.03}) {
        Scene one = scene;
        addPolygons(one, "pedestal", 0, boxFaces({1 + over, 0, 1}, {2, 0.5, 2}));
        addPolygons(one, "box", 0, boxFaces({1, 0.5, 1}, {2, 1.0, 2}));
        const ReachedSides reached = reach(one);
        EXPECT_FALSE(reached.isReached(2, true));
        EXPECT_FALSE(reached.isReached(3, true));
        EXPECT_EQ(reached.isReached(3, 2, false), over > 0.0);
        EXPECT_FALSE(reached.isOpen);
    }
}

// Points of all patches that were dropped, by the path tracer.
TEST(Buried, nothingThatIsLitIsDropped) {
    const Scene scene = scene::buildBuilding("building:10000");
    const Executor executor(2);
    const rays::RayScene rays(scene, executor);
    const ReachedSides reached = hierarchy::findReachedSides(scene, rays, executor, 1);
    std::vector<scene::Sensor> sensors;
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        const surface::Surface& surface = *scene.objects[o].surface;
        for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
            for (const bool back : {false, true}) {
                if (!reached.isReached(o, back) || reached.isReached(o, patch, back)) {
                    continue;
                }
                base::RandomStream random(base::combine(o, 2 * patch + (back ? 1 : 0)));
                for (unsigned i = 0; i < 4; ++i) {
                    const auto whole = surface::wholePatch(surface.domain(patch));
                    const auto p = surface.evaluate(patch, mapToRegion(whole, random.next2()).uv);
                    sensors.push_back({p.position, back ? -p.normal : p.normal});
                }
            }
        }
    }
    EXPECT_GT(sensors.size(), 4u * 2000u);
    const auto traced = reference::traceIrradiance(scene, rays, executor, sensors, {5, 16});
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const Vec3d& at = sensors[i].position;
        EXPECT_EQ(traced.irradiance[i].mean, Vec3d(0.0)) << at.x << " " << at.y << " " << at.z;
    }
}

TEST(Buried, doesNotDependOnThreads) {
    const Scene scene = scene::buildBuilding("building:10000");
    const ReachedSides once = reach(scene, 1);
    const ReachedSides again = reach(scene, 4);
    EXPECT_EQ(once.sides, again.sides);
    EXPECT_EQ(once.buried, again.buried);
    EXPECT_FALSE(once.isOpen);
}

TEST(ClosedMesh, boxesAreClosedAndRoomsAreInsideOut) {
    Scene scene;
    addPolygons(scene, "box", 0, boxFaces(Vec3d(1e3), Vec3d(1e3 + 1.0)));
    EXPECT_TRUE(hierarchy::isClosedOutwards(lastSurface(scene)));
    addPolygons(scene, "two", 0, join({boxFaces(Vec3d(0.0), Vec3d(1.0)), boxFaces(Vec3d(2.0), Vec3d(3.0))}));
    EXPECT_TRUE(hierarchy::isClosedOutwards(lastSurface(scene)));
    addPolygons(scene, "room", 0, boxFaces(Vec3d(0.0), Vec3d(1.0), scene::kAllFaces, true));
    EXPECT_FALSE(hierarchy::isClosedOutwards(lastSurface(scene)));
    addPolygons(
        scene, "box and room", 0,
        join({boxFaces(Vec3d(0.0), Vec3d(9.0)), boxFaces(Vec3d(2.0), Vec3d(3.0), scene::kAllFaces, true)}));
    EXPECT_FALSE(hierarchy::isClosedOutwards(lastSurface(scene)));
    addPolygons(scene, "open", 0, boxFaces(Vec3d(0.0), Vec3d(1.0), scene::kStanding));
    EXPECT_FALSE(hierarchy::isClosedOutwards(lastSurface(scene)));
    Quads torn = boxFaces(Vec3d(0.0), Vec3d(1.0));
    torn[0][0].x -= 1e-4;
    addPolygons(scene, "torn", 0, torn);
    EXPECT_FALSE(hierarchy::isClosedOutwards(lastSurface(scene)));
    EXPECT_FALSE(hierarchy::isClosedOutwards(surface::Sphere(Vec3d(0.0), 1.0))) << "no mesh";
}

// The certificate of closed meshes must not hide what is lit from within.
TEST(ClosedMesh, lightInsideOfAClosedMeshIsFound) {
    for (const bool isPoint : {false, true}) {
        Scene scene = buildRoom();
        addPolygons(scene, "lantern", 0, boxFaces({1, 0.5, 1}, {1.5, 1.0, 1.5}));
        EXPECT_FALSE(reach(scene).isReached(2, true));
        if (isPoint) {
            scene::Light light;
            light.position = {1.25, 0.75, 1.25};
            scene.lights.push_back(light);
        } else {
            addPolygons(scene, "wick", 1, boxFaces({1.2, 0.7, 1.2}, {1.3, 0.8, 1.3}));
        }
        EXPECT_TRUE(reach(scene).isReached(2, true));
    }
}

}  // namespace
}  // namespace fluxwalk
