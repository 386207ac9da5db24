#include "viewer/ui/walker.h"

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "viewer/render/camera.h"

namespace fluxwalk::ui {
namespace {

using base::Vec3d;

base::Box makeRoom() {
    base::Box box;
    box.extend(Vec3d(0.0));
    box.extend(Vec3d(8.0, 3.0, 8.0));
    return box;
}

Walker makeWalker(const Vec3d& eye, const Vec3d& target) {
    Walker walker(render::lookAt(eye, target, 50.0), makeRoom());
    walker.speed = 2.0;
    return walker;
}

void expectNear(const Vec3d& a, const Vec3d& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0, 1e-9) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Walker, KeepsTheCameraUntilMoved) {
    scene::Camera tilted = render::lookAt({1.0, 1.0, 1.0}, {2.0, 0.5, 0.0}, 50.0);
    tilted.up = glm::normalize(Vec3d(0.3, 1.0, 0.0));
    Walker walker(tilted, makeRoom());
    EXPECT_FALSE(walker.update({}, 0.1, {}));
    expectNear(walker.camera().up, tilted.up);
    expectNear(walker.camera().forward, tilted.forward);
}

TEST(Walker, FliesWhereItLooks) {
    Walker walker = makeWalker({1.0, 1.0, 1.0}, {1.0, 0.0, 0.0});
    WalkInput input;
    input.ahead = 1.0;
    EXPECT_TRUE(walker.update(input, 0.5, {}));
    expectNear(walker.camera().position, Vec3d(1.0, 1.0, 1.0) + glm::normalize(Vec3d(0.0, -1.0, -1.0)));
}

TEST(Walker, TurnsRightAndUpAndWalksThere) {
    Walker walker = makeWalker({4.0, 1.0, 4.0}, {4.0, 1.0, 0.0});
    WalkInput look;
    look.turn = 0.5 * base::kPi;
    walker.update(look, 0.1, {});
    expectNear(walker.camera().forward, {1.0, 0.0, 0.0});
    look.turn = 0.0;
    look.tilt = 0.25 * base::kPi;
    walker.update(look, 0.1, {});
    EXPECT_NEAR(walker.camera().forward.y, std::sqrt(0.5), 1e-9);
    look.tilt = 10.0;  // not over the top
    walker.update(look, 0.1, {});
    EXPECT_GT(walker.camera().forward.y, 0.99);
    EXPECT_GT(walker.camera().forward.x, 0.0);
    WalkInput aside;
    aside.right = 1.0;
    walker.update(aside, 0.5, {});
    expectNear(walker.camera().position, {4.0, 1.0, 5.0});
}

TEST(Walker, DiagonalsAreNotFaster) {
    Walker walker = makeWalker({4.0, 1.0, 4.0}, {4.0, 1.0, 0.0});
    WalkInput input;
    input.ahead = input.right = 1.0;
    walker.update(input, 0.5, {});
    EXPECT_NEAR(glm::length(walker.camera().position - Vec3d(4.0, 1.0, 4.0)), 1.0, 1e-9);
    input.fast = true;
    walker.update(input, 0.5, {});
    EXPECT_NEAR(glm::length(walker.camera().position - Vec3d(4.0, 1.0, 4.0)), 4.0, 1e-9);
}

TEST(Walker, WalksLevelAtItsEyeHeightAndFollowsTheFloor) {
    Walker walker = makeWalker({4.0, 1.4, 4.0}, {4.0, 0.0, 0.0});
    walker.movement = Movement::walk;
    const FindFloor steps = [](const Vec3d& p) { return std::optional(p.z < 3.0 ? 0.3 : 0.0); };
    WalkInput input;
    input.ahead = 1.0;
    walker.update(input, 0.25, steps);
    EXPECT_NEAR(walker.eyeHeight, 1.4, 1e-12);  // taken over from where it stood
    expectNear(walker.camera().position, {4.0, 1.4, 3.5});
    walker.update(input, 0.5, steps);
    EXPECT_NEAR(walker.camera().position.z, 2.5, 1e-9);
    int frames = 0;
    while (walker.update({}, 0.016, steps)) {
        ASSERT_LT(++frames, 1000);
    }
    EXPECT_NEAR(walker.camera().position.y, 1.7, 1e-3);
}

TEST(Walker, ComesDownToTheFloorFromAbove) {
    Walker walker = makeWalker({4.0, 9.0, 4.0}, {4.0, 9.0, 0.0});
    walker.movement = Movement::walk;
    while (walker.update({}, 0.05, [](const Vec3d&) { return std::optional(0.5); })) {
    }
    EXPECT_NEAR(walker.camera().position.y, 0.5 + 1.65, 1e-3);
}

TEST(Walker, SpeedFollowsTheScene) {
    base::Box model;
    model.extend(Vec3d(0.0));
    model.extend(Vec3d(0.3, 0.3, 0.3));
    EXPECT_LT(Walker(scene::Camera{}, model).speed, 0.2);
    EXPECT_NEAR(Walker(scene::Camera{}, makeRoom()).speed, 1.5, 1e-12);
}

}  // namespace
}  // namespace fluxwalk::ui
