#include "viewer/ui/orbit.h"

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "viewer/render/camera.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

TEST(Orbit, KeepsDistanceAndPlaceOfThePivotInThePicture) {
    scene::Camera camera = render::lookAt({3, 2, 4}, {0, 1, 0}, 50.0);
    const Vec3d pivot(0.5, 1.5, 0.2);
    const auto placeOf = [&](const scene::Camera& c) {
        const glm::dvec4 clip =
            glm::dmat4(render::clipFromWorld(c, 1.5, {0.01, 100.0})) * glm::dvec4(pivot, 1.0);
        return base::Vec2d(clip.x / clip.w, clip.y / clip.w);
    };
    const base::Vec2d place = placeOf(camera);
    const double distance = glm::length(camera.position - pivot);
    for (int i = 0; i < 50; ++i) {
        const scene::Camera before = camera;
        camera = orbit(camera, pivot, 0.2, i % 7 == 0 ? 0.3 : -0.1);
        EXPECT_NEAR(glm::length(camera.position - pivot), distance, 1e-9);
        EXPECT_NEAR(glm::length(placeOf(camera) - place), 0.0, 1e-5);
        EXPECT_NE(camera.position, before.position);
        EXPECT_LT(std::abs(camera.forward.y), 1.0 - 1e-7);
    }
}

TEST(Orbit, TurnsAsMouseLookDoes) {
    const scene::Camera camera = render::lookAt({0, 0, 5}, {0, 0, 0}, 50.0);
    const scene::Camera right = orbit(camera, Vec3d(0.0), 0.5 * base::kPi, 0.0);
    EXPECT_NEAR(right.forward.x, 1.0, 1e-12);
    EXPECT_NEAR(right.position.x, -5.0, 1e-12);
    const scene::Camera above = orbit(camera, Vec3d(0.0), 0.0, -10.0);
    EXPECT_GT(above.position.y, 4.99);
    EXPECT_GT(above.position.z, 0.0);
}

TEST(Orbit, DollyComesNearButNotThrough) {
    scene::Camera camera = render::lookAt({0, 0, 5}, {0, 0, 0}, 50.0);
    camera = dolly(camera, Vec3d(0.0), 0.5, 0.1);
    EXPECT_NEAR(camera.position.z, 2.5, 1e-12);
    for (int i = 0; i < 30; ++i) {
        camera = dolly(camera, Vec3d(0.0), 0.5, 0.1);
    }
    EXPECT_NEAR(camera.position.z, 0.1, 1e-12);
    EXPECT_NEAR(dolly(camera, Vec3d(0.0), 10.0, 0.1).position.z, 1.0, 1e-12);
}

TEST(Orbit, AWholeBoxIsInThePicture) {
    base::Box box;
    box.extend(Vec3d(1, 2, 3));
    box.extend(Vec3d(2, 5, 4));
    const scene::Camera camera = lookAtWhole(render::lookAt({9, 9, 9}, {0, 9, 9}, 40.0), box);
    const glm::dmat4 clip(render::clipFromWorld(camera, 1.0, {0.01, 100.0}));
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d p((corner & 1) != 0 ? 1 : 2, (corner & 2) != 0 ? 2 : 5, (corner & 4) != 0 ? 3 : 4);
        const glm::dvec4 seen = clip * glm::dvec4(p, 1.0);
        EXPECT_LT(std::abs(seen.x), seen.w);
        EXPECT_LT(std::abs(seen.y), seen.w);
    }
}

}  // namespace
}  // namespace fluxwalk::ui
