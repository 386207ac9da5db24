#include "viewer/app/first_view.h"

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "tests/viewer/test_room.h"
#include "viewer/app/floor.h"

namespace fluxwalk::app {
namespace {

using base::Vec3d;

/// A box of the given size with its normals inwards; without the side towards +z where `isOpen`.
std::shared_ptr<const scene::Scene> makeBox(float w, float h, float d, bool isOpen) {
    const auto quad = [](base::Vec3 a, base::Vec3 b, base::Vec3 c, base::Vec3 e) {
        return std::make_shared<const scene::LitMesh>(testing::makeQuad(a, b, c, e, 2));
    };
    scene::LitMeshes meshes{
        quad({0, 0, d}, {w, 0, d}, {w, 0, 0}, {0, 0, 0}), quad({0, h, 0}, {w, h, 0}, {w, h, d}, {0, h, d}),
        quad({0, 0, 0}, {w, 0, 0}, {w, h, 0}, {0, h, 0}), quad({0, 0, d}, {0, 0, 0}, {0, h, 0}, {0, h, d}),
        quad({w, 0, 0}, {w, 0, d}, {w, h, d}, {w, h, 0})};
    if (!isOpen) {
        meshes.push_back(quad({w, 0, d}, {0, 0, d}, {0, h, d}, {w, h, d}));
    }
    return std::make_shared<const scene::Scene>(sceneOfMeshes(meshes));
}

TEST(FirstView, InsideAClosedRoomAlongItsLength) {
    const Solid room(makeBox(10.0f, 3.0f, 4.0f, false));
    const base::Box bounds = room.scene->bounds();
    const scene::Camera camera = chooseFirstView(room.rays, bounds);
    EXPECT_TRUE(glm::all(glm::greaterThan(camera.position, bounds.lower)));
    EXPECT_TRUE(glm::all(glm::lessThan(camera.position, bounds.upper)));
    EXPECT_NEAR(camera.position.y, 1.65, 0.05);
    // Along the longest line, from near one end to the other.
    EXPECT_GT(std::abs(camera.forward.x), 0.85);
    EXPECT_GT(std::abs(camera.position.x - 5.0), 2.5);
    EXPECT_LT(camera.forward.x * (camera.position.x - 5.0), 0.0);
}

TEST(FirstView, ThroughTheOpeningOfABox) {
    const Solid box(makeBox(2.0f, 2.0f, 2.0f, true));
    const scene::Camera camera = chooseFirstView(box.rays, box.scene->bounds());
    EXPECT_GT(camera.position.z, 3.0);
    EXPECT_LT(camera.forward.z, -0.95);
}

TEST(FirstView, FromAboveACornerOfAnObject) {
    scene::LitMeshes plate{std::make_shared<const scene::LitMesh>(
        testing::makeQuad({0, 0, 4}, {4, 0, 4}, {4, 0, 0}, {0, 0, 0}, 2))};
    const Solid solid(std::make_shared<const scene::Scene>(sceneOfMeshes(plate)));
    const scene::Camera camera = chooseFirstView(solid.rays, solid.scene->bounds());
    EXPECT_GT(camera.position.y, 1.0);
    EXPECT_LT(camera.forward.y, -0.2);
    const Vec3d toCenter = glm::normalize(Vec3d(2.0, 0.0, 2.0) - camera.position);
    EXPECT_GT(glm::dot(toCenter, camera.forward), 0.999);
}

TEST(FirstView, OnTheFloorNotBelowIt) {
    // The gallery's floor lies at half the height of its box: its vault is a whole cylinder.
    const Solid hall(std::make_shared<const scene::Scene>(scene::buildGallery()));
    const scene::Camera camera = chooseFirstView(hall.rays, hall.scene->bounds());
    EXPECT_NEAR(camera.position.y, 1.65, 0.05);
    EXPECT_GT(std::abs(camera.forward.x), 0.85);
}

TEST(FirstView, OfNothing) {
    const auto empty = std::make_shared<const scene::Scene>();
    const Solid solid(empty);
    EXPECT_NEAR(glm::length(chooseFirstView(solid.rays, empty->bounds()).forward), 1.0, 1e-9);
}

TEST(Floor, IsFoundOnceReady) {
    Floor floor(makeBox(4.0f, 3.0f, 4.0f, false));
    while (!floor.isReady()) {
    }
    EXPECT_NEAR(floor.below({1.0, 2.0, 1.5}).value(), 0.0, 1e-5);
    EXPECT_FALSE(floor.below({9.0, 2.0, 1.5}).has_value());
}

}  // namespace
}  // namespace fluxwalk::app
