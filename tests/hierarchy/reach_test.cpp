#include "core/hierarchy/reach.h"

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/surface/sphere.h"

namespace fluxwalk {
namespace {

using base::Executor;
using base::Rgb;
using base::Vec3d;
using hierarchy::ReachedSides;
using scene::boxFaces;
using scene::Scene;

ReachedSides reach(const Scene& scene, std::uint64_t seed = 1, unsigned threads = 1) {
    const Executor executor(threads);
    const rays::RayScene rays(scene, executor);
    return hierarchy::findReachedSides(scene, rays, executor, seed);
}

struct Materials {
    std::uint32_t wall = 0;
    std::uint32_t lamp = 0;
};

Materials addMaterials(Scene& scene) {
    const std::uint32_t wall = scene::addMaterial(scene, "wall", Rgb(0.5f));
    return {wall, scene::addMaterial(scene, "lamp", Rgb(0.5f), Rgb(100.0f))};
}

// A closed room of 4 x 3 x 4 m: object "room".
Materials addRoom(Scene& scene, const Vec3d& at = Vec3d(0.0)) {
    const Materials materials = addMaterials(scene);
    scene::addPolygons(scene, "room", materials.wall,
                       boxFaces(at, at + Vec3d(4, 3, 4), scene::kAllFaces, true));
    return materials;
}

void addCeilingLamp(Scene& scene, std::uint32_t material) {
    scene::addPolygons(scene, "lamp", material, boxFaces({1.5, 2.9, 1.5}, {2.5, 2.9, 2.5}, scene::kBottom));
}

std::uint32_t objectNamed(const Scene& scene, std::string_view name) {
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].name == name) {
            return i;
        }
    }
    ADD_FAILURE() << "no object " << name;
    return 0;
}

void expectSides(const Scene& scene, const ReachedSides& reached, std::string_view name, bool front,
                 bool back) {
    const std::uint32_t object = objectNamed(scene, name);
    EXPECT_EQ(reached.isReached(object, false), front) << name << " front";
    EXPECT_EQ(reached.isReached(object, true), back) << name << " back";
}

TEST(Reach, theInsideOfAClosedBoxIsDark) {
    Scene scene;
    const Materials materials = addRoom(scene);
    addCeilingLamp(scene, materials.lamp);
    scene::addPolygons(scene, "box", materials.wall, boxFaces({1, 0.5, 1}, {2, 1.5, 2}));
    scene.objects.push_back({"ball", std::make_shared<surface::Sphere>(Vec3d(3, 1, 3), 0.5), materials.wall});
    // In the box, unseen from anywhere.
    scene::addPolygons(scene, "treasure", materials.wall, boxFaces({1.4, 0.9, 1.4}, {1.6, 1.1, 1.6}));
    const ReachedSides reached = reach(scene);
    expectSides(scene, reached, "room", true, false);
    expectSides(scene, reached, "box", true, false);
    expectSides(scene, reached, "ball", true, false);
    expectSides(scene, reached, "treasure", false, false);
    // A lamp of one side hangs 10 cm below the ceiling: its back is lit by reflection.
    expectSides(scene, reached, "lamp", true, true);
    EXPECT_FALSE(reached.isOpen);
}

TEST(Reach, aBlockWithoutBottomOnTheFloor) {
    Scene scene;
    const Materials materials = addRoom(scene);
    addCeilingLamp(scene, materials.lamp);
    scene::addPolygons(scene, "block", materials.wall, boxFaces({1, 0, 1}, {2, 1.5, 2}, scene::kStanding));
    const ReachedSides reached = reach(scene);
    // The floor under the block sees the block's inside, and the floor's object is reached elsewhere.
    expectSides(scene, reached, "block", true, false);
    expectSides(scene, reached, "room", true, false);
}

TEST(Reach, aLampInTheBoxTurnsItInsideOut) {
    const Scene scene = scene::buildLampBox();
    const ReachedSides reached = reach(scene);
    expectSides(scene, reached, "room", false, false);
    expectSides(scene, reached, "box", false, true);
    EXPECT_TRUE(reached.isReached(objectNamed(scene, "lamp"), false));
    EXPECT_FALSE(reached.isOpen);
}

TEST(Reach, aThinWallBetweenTwoLitRoomsHasTwoSides) {
    Scene scene;
    const Materials materials = addRoom(scene);
    scene::addPolygons(scene, "partition", materials.wall, boxFaces({2, 0, 0}, {2, 3, 4}, scene::kRight));
    scene::addPolygons(scene, "lamp", materials.lamp, boxFaces({3, 2.9, 1}, {3.5, 2.9, 2}, scene::kBottom));
    expectSides(scene, reach(scene), "partition", true, false);
    scene::addPolygons(scene, "other lamp", materials.lamp,
                       boxFaces({0.5, 2.9, 1}, {1, 2.9, 2}, scene::kBottom));
    expectSides(scene, reach(scene), "partition", true, true);
}

TEST(Reach, lightPassesTheDoor) {
    const Scene scene = scene::buildTwoRooms();
    const ReachedSides reached = reach(scene);
    for (const std::string_view name : {"floor", "ceiling", "walls of the lit room", "walls of the dark room",
                                        "door frame", "bed frame", "mattress", "wardrobe", "desk", "stool"}) {
        EXPECT_TRUE(reached.isReached(objectNamed(scene, name), false)) << name;
    }
    EXPECT_FALSE(reached.isReached(objectNamed(scene, "ceiling"), true));
    EXPECT_FALSE(reached.isReached(objectNamed(scene, "mattress"), true));
    EXPECT_FALSE(reached.isOpen);
}

TEST(Reach, lightsWithoutArea) {
    for (const scene::LightKind kind :
         {scene::LightKind::point, scene::LightKind::spot, scene::LightKind::directional}) {
        Scene scene;
        const Materials materials = addMaterials(scene);
        scene::addPolygons(scene, "table", materials.wall, boxFaces({-1, 0, -1}, {1, 0, 1}, scene::kTop));
        scene::addPolygons(scene, "under", materials.wall,
                           boxFaces({-1, -1, -1}, {1, -1, 1}, scene::kBottom));
        scene::Light light;
        light.kind = kind;
        light.position = {0.2, 2, 0.1};
        light.direction = {0, -1, 0};
        scene.lights.push_back(light);
        const ReachedSides reached = reach(scene);
        EXPECT_TRUE(reached.isReached(0, false));
        EXPECT_FALSE(reached.isReached(1, false)) << "faces away from the light, and sees nothing";
        EXPECT_TRUE(reached.isOpen);
    }
}

TEST(Reach, aClosedRoomIsClosedWhateverLightsIt) {
    for (const scene::LightKind kind : {scene::LightKind::point, scene::LightKind::spot}) {
        Scene scene;
        addRoom(scene);
        scene::Light light;
        light.kind = kind;
        light.position = {1.0, 2.0, 1.5};
        scene.lights.push_back(light);
        const ReachedSides reached = reach(scene);
        expectSides(scene, reached, "room", true, false);
        EXPECT_FALSE(reached.isOpen);
    }
}

TEST(Reach, aSpotLightsOnlyItsCone) {
    Scene scene;
    const Materials materials = addMaterials(scene);
    scene::addPolygons(scene, "lit", materials.wall, boxFaces({-0.3, 0, -0.3}, {0.3, 0, 0.3}, scene::kTop));
    scene::addPolygons(scene, "beside", materials.wall, boxFaces({3, 0, -1}, {4, 0, 1}, scene::kTop));
    scene::Light light;
    light.kind = scene::LightKind::spot;
    light.position = {0, 1, 0};
    light.innerConeAngle = 0.2;
    light.outerConeAngle = 0.4;
    scene.lights.push_back(light);
    const ReachedSides reached = reach(scene);
    EXPECT_TRUE(reached.isReached(0, false));
    EXPECT_FALSE(reached.isReached(1, false)) << "outside the cone";
}

TEST(Reach, theSkyComesFromAboveAndLeavesOpenScenes) {
    Scene scene;
    const Materials materials = addMaterials(scene);
    scene.sky = Rgb(1000.0f);
    scene::addPolygons(scene, "ground", materials.wall, boxFaces({-5, 0, -5}, {5, 0, 5}, scene::kTop));
    scene::addPolygons(scene, "house", materials.wall, boxFaces({-1, 0, -1}, {1, 1, 1}, scene::kStanding));
    scene::addPolygons(scene, "inside", materials.wall, boxFaces({-0.5, 0.2, -0.5}, {0.5, 0.6, 0.5}));
    const ReachedSides reached = reach(scene);
    expectSides(scene, reached, "ground", true, false);
    expectSides(scene, reached, "house", true, false);
    expectSides(scene, reached, "inside", false, false);
    EXPECT_TRUE(reached.isOpen);
}

TEST(Reach, emissiveSides) {
    Scene scene;
    const Materials materials = addMaterials(scene);
    scene.materials[materials.lamp].reflectance = Rgb(0.0f);
    scene::addPolygons(scene, "lamp", materials.lamp, boxFaces({0, 2, 0}, {1, 2, 1}, scene::kBottom));
    scene::addPolygons(scene, "above", materials.wall, boxFaces({0, 4, 0}, {1, 4, 1}, scene::kBottom));
    ReachedSides reached = reach(scene);
    expectSides(scene, reached, "lamp", true, false);
    expectSides(scene, reached, "above", false, false);
    EXPECT_TRUE(reached.isOpen);
    scene.materials[materials.lamp].doubleSided = true;
    reached = reach(scene);
    expectSides(scene, reached, "lamp", true, true);
    expectSides(scene, reached, "above", true, false);
}

TEST(Reach, doesNotDependOnThreadsAndRarelyOnTheSeed) {
    const Scene scene = scene::buildTwoRooms();
    const ReachedSides once = reach(scene, 1, 1);
    EXPECT_EQ(once.sides, reach(scene, 1, 4).sides);
    for (std::uint64_t seed = 2; seed < 8; ++seed) {
        EXPECT_EQ(once.sides, reach(scene, seed).sides) << seed;
    }
}

TEST(Reach, scenesWithoutLightOrObjects) {
    EXPECT_TRUE(reach(Scene{}).sides.empty());
    Scene dark;
    addRoom(dark);
    expectSides(dark, reach(dark), "room", false, false);
}

}  // namespace
}  // namespace fluxwalk
