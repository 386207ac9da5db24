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
    EXPECT_FALSE(walker.update({}, 0.1, nullptr));
    expectNear(walker.camera().up, tilted.up);
    expectNear(walker.camera().forward, tilted.forward);
}

TEST(Walker, FliesWhereItLooks) {
    Walker walker = makeWalker({1.0, 1.0, 1.0}, {1.0, 0.0, 0.0});
    WalkInput input;
    input.ahead = 1.0;
    EXPECT_TRUE(walker.update(input, 0.5, nullptr));
    expectNear(walker.camera().position, Vec3d(1.0, 1.0, 1.0) + glm::normalize(Vec3d(0.0, -1.0, -1.0)));
}

TEST(Walker, TurnsRightAndUpAndWalksThere) {
    Walker walker = makeWalker({4.0, 1.0, 4.0}, {4.0, 1.0, 0.0});
    WalkInput look;
    look.turn = 0.5 * base::kPi;
    walker.update(look, 0.1, nullptr);
    expectNear(walker.camera().forward, {1.0, 0.0, 0.0});
    look.turn = 0.0;
    look.tilt = 0.25 * base::kPi;
    walker.update(look, 0.1, nullptr);
    EXPECT_NEAR(walker.camera().forward.y, std::sqrt(0.5), 1e-9);
    look.tilt = 10.0;  // not over the top
    walker.update(look, 0.1, nullptr);
    EXPECT_GT(walker.camera().forward.y, 0.99);
    EXPECT_GT(walker.camera().forward.x, 0.0);
    WalkInput aside;
    aside.right = 1.0;
    walker.update(aside, 0.5, nullptr);
    expectNear(walker.camera().position, {4.0, 1.0, 5.0});
}

TEST(Walker, DiagonalsAreNotFaster) {
    Walker walker = makeWalker({4.0, 1.0, 4.0}, {4.0, 1.0, 0.0});
    WalkInput input;
    input.ahead = input.right = 1.0;
    walker.update(input, 0.5, nullptr);
    EXPECT_NEAR(glm::length(walker.camera().position - Vec3d(4.0, 1.0, 4.0)), 1.0, 1e-9);
    input.fast = true;
    walker.update(input, 0.5, nullptr);
    EXPECT_NEAR(glm::length(walker.camera().position - Vec3d(4.0, 1.0, 4.0)), 4.0, 1e-9);
}

TEST(Walker, WalksLevelWhereverItLooks) {
    Walker walker = makeWalker({4.0, 1.4, 4.0}, {4.0, 0.0, 0.0});
    walker.movement = Movement::walk;
    WalkInput input;
    input.ahead = 1.0;
    walker.update(input, 0.25, nullptr);
    expectNear(walker.camera().position, {4.0, 1.4, 3.5});
}

TEST(Walker, SpeedFollowsTheScene) {
    base::Box model;
    model.extend(Vec3d(0.0));
    model.extend(Vec3d(0.3, 0.3, 0.3));
    EXPECT_LT(Walker(scene::Camera{}, model).speed, 0.2);
    EXPECT_LT(Walker(scene::Camera{}, model).eyeHeight, 0.2);
    EXPECT_NEAR(Walker(scene::Camera{}, makeRoom()).speed, 1.5, 1e-12);
    EXPECT_NEAR(Walker(scene::Camera{}, makeRoom()).eyeHeight, 1.6, 1e-12);
}

}  // namespace
}  // namespace fluxwalk::ui
