#include "core/scene/camera_path.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/photometry.h"

namespace fluxwalk::scene {
namespace {

Camera lookingAt(double degrees, const Vec3d& position) {
    Camera camera;
    camera.position = position;
    const double angle = degrees * base::kPi / 180.0;
    camera.forward = Vec3d(std::sin(angle), 0.0, -std::cos(angle));
    return camera;
}

double headingOf(const Camera& camera) {
    return std::atan2(camera.forward.x, -camera.forward.z) * 180.0 / base::kPi;
}

TEST(CameraPath, PassesItsKeysAndRestsAtItsEnds) {
    CameraPath path{{2.0, lookingAt(0, {0, 1, 0})},
                    {3.0, lookingAt(40, {1, 1, -2})},
                    {3.5, lookingAt(-20, {4, 2, -2})},
                    {6.0, lookingAt(-90, {4, 2, 5})}};
    path[2].camera.verticalFov = 1.2;
    EXPECT_NEAR(durationOf(path), 4.0, 1e-12);
    for (const CameraKey& key : path) {
        const Camera camera = cameraAt(path, key.seconds - 2.0);
        EXPECT_NEAR(glm::length(camera.position - key.camera.position), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(camera.forward - key.camera.forward), 0.0, 1e-9);
        EXPECT_NEAR(camera.verticalFov, key.camera.verticalFov, 1e-12);
    }
    EXPECT_EQ(cameraAt(path, -5.0).position, path.front().camera.position);
    EXPECT_EQ(cameraAt(path, 99.0).position, path.back().camera.position);
}

TEST(CameraPath, MovesSmoothlyAndNeverSwingsOut) {
    const CameraPath path{{0.0, lookingAt(0, {0, 1, 0})},
                          {1.0, lookingAt(10, {1, 1, 0})},
                          {1.2, lookingAt(80, {3, 1, -2})},
                          {4.0, lookingAt(85, {3, 1, -2.1})},
                          {5.0, lookingAt(170, {5, 1, -2.1})}};
    constexpr double kStep = 1e-4;
    Camera before = cameraAt(path, 0.0);
    double pace = -1.0;
    for (double t = kStep; t < 5.0; t += kStep) {
        const Camera now = cameraAt(path, t);
        const double present = glm::length(now.position - before.position) / kStep;
        EXPECT_LT(std::abs(present - pace), pace < 0.0 ? 1e9 : 0.05) << t;
        EXPECT_LT(glm::length(now.forward - before.forward), 0.002) << t;
        EXPECT_NEAR(glm::length(now.forward), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(now.forward, now.up), 0.0, 1e-12);
        EXPECT_GE(now.position.x, -1e-12);
        EXPECT_LE(now.position.x, 5.0 + 1e-12);
        EXPECT_LE(now.position.z, 1e-12);
        EXPECT_GE(now.position.z, -2.1 - 1e-12);
        EXPECT_GE(headingOf(now), -1e-6);
        pace = present;
        before = now;
    }
}

TEST(CameraPath, TakesTheShortWayRound) {
    const CameraPath path{{0.0, lookingAt(170, {})}, {1.0, lookingAt(190, {})}};
    EXPECT_NEAR(std::abs(headingOf(cameraAt(path, 0.5))), 180.0, 1e-6);
}

TEST(CameraPath, OneKeyIsAPlace) {
    const CameraPath path{{1.0, lookingAt(30, {1, 2, 3})}};
    EXPECT_EQ(durationOf(path), 0.0);
    EXPECT_EQ(cameraAt(path, 0.5).position, Vec3d(1, 2, 3));
}

TEST(CameraFault, NamesWhatIsAbsurd) {
    EXPECT_FALSE(findFault(Camera{}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Camera bad;
    bad.position.y = nan;
    EXPECT_TRUE(findFault(bad));
    bad = {};
    bad.position.x = 1e9;
    EXPECT_TRUE(findFault(bad));
    bad = {};
    bad.forward = Vec3d(0.0);
    EXPECT_TRUE(findFault(bad));
    bad = {};
    bad.up = bad.forward;
    EXPECT_TRUE(findFault(bad));
    for (const double fov : {0.0, -1.0, 3.2, nan}) {
        bad = {};
        bad.verticalFov = fov;
        EXPECT_TRUE(findFault(bad)) << fov;
    }
}

}  // namespace
}  // namespace fluxwalk::scene
