#include "viewer/render/camera.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/cli/camera_arguments.h"
#include "viewer/app/picture_size.h"

namespace fluxwalk::render {
namespace {

using base::Vec3d;

/// Normalised device coordinates of a point.
glm::vec3 project(const glm::mat4& clipFromWorld, const Vec3d& point) {
    const glm::vec4 clip = clipFromWorld * glm::vec4(glm::vec3(point), 1.0f);
    return glm::vec3(clip) / clip.w;
}

TEST(Camera, ProjectsTheEdgesOfItsFieldOfView) {
    const scene::Camera camera = lookAt({1.0, 2.0, 3.0}, {1.0, 2.0, -7.0}, 90.0);
    const glm::mat4 matrix = clipFromWorld(camera, 2.0, {0.1, 100.0});
    const glm::vec3 center = project(matrix, {1.0, 2.0, -7.0});
    EXPECT_NEAR(center.x, 0.0f, 1e-5f);
    EXPECT_NEAR(center.y, 0.0f, 1e-5f);
    // 90 degrees: at distance 5 the picture is 5 above and, twice as wide, 10 to the right.
    const glm::vec3 corner = project(matrix, {11.0, 7.0, -2.0});
    EXPECT_NEAR(corner.x, 1.0f, 1e-5f);
    EXPECT_NEAR(corner.y, 1.0f, 1e-5f);
    EXPECT_NEAR(project(matrix, {1.0, 2.0, 2.9}).z, -1.0f, 1e-4f);
    EXPECT_NEAR(project(matrix, {1.0, 2.0, -97.0}).z, 1.0f, 1e-4f);
}

TEST(Camera, LooksStraightDown) {
    const scene::Camera camera = lookAt({0.0, 5.0, 0.0}, {0.0, 0.0, 0.0}, 60.0);
    const glm::vec3 north = project(clipFromWorld(camera, 1.0, {0.1, 10.0}), {0.0, 0.0, -1.0});
    EXPECT_GT(north.y, 0.1f);
    EXPECT_NEAR(north.x, 0.0f, 1e-5f);
}

TEST(Camera, RefusesNonsense) {
    EXPECT_THROW(lookAt({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, 50.0), base::UsageError);
    EXPECT_THROW(lookAt({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 0.0), base::UsageError);
    EXPECT_THROW(lookAt({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 180.0), base::UsageError);
}

TEST(Camera, ClipRangeHoldsTheWholeBox) {
    base::Box box;
    box.extend(Vec3d(-1.0, 0.0, -2.0));
    box.extend(Vec3d(3.0, 4.0, 2.0));
    for (const Vec3d& eye : {Vec3d(0.0, 1.0, 0.0), Vec3d(30.0, 10.0, -20.0)}) {
        const ClipRange range = clipRangeFor(lookAt(eye, box.center(), 50.0), box);
        double farthest = 0.0;
        for (int i = 0; i < 8; ++i) {
            const Vec3d corner((i & 1) != 0 ? 3.0 : -1.0, (i & 2) != 0 ? 4.0 : 0.0,
                               (i & 4) != 0 ? 2.0 : -2.0);
            farthest = std::max(farthest, glm::length(corner - eye));
        }
        EXPECT_GT(range.farthest, farthest);
        EXPECT_LT(range.farthest, 1.1 * farthest);
        EXPECT_GT(range.nearest, 0.0);
        EXPECT_LE(range.nearest, 0.02);
    }
}

class ChooseCamera : public ::testing::Test {
  protected:
    ChooseCamera() {
        scene_.cameras.resize(2);
        scene_.cameras[0].name = "door";
        scene_.cameras[1].name = "window";
        scene_.cameras[1].verticalFov = 0.5;
    }
    scene::Camera choose(const cli::CameraArguments& arguments) const {
        return cli::chooseCamera(arguments, scene_, [] {
            scene::Camera camera;
            camera.name = "first view";
            return camera;
        });
    }
    scene::Scene scene_;
};

TEST_F(ChooseCamera, ByNameEyeOrDefault) {
    cli::CameraArguments arguments;
    EXPECT_EQ(choose(arguments).name, "door");
    arguments.name = "window";
    EXPECT_EQ(choose(arguments).verticalFov, 0.5);
    arguments.fov = 90.0;
    EXPECT_NEAR(choose(arguments).verticalFov, 0.5 * base::kPi, 1e-12);
    arguments = {};
    arguments.eye = {1.0, 2.0, 3.0};
    arguments.target = {1.0, 2.0, 0.0};
    EXPECT_EQ(choose(arguments).forward, Vec3d(0.0, 0.0, -1.0));
    EXPECT_NEAR(choose(arguments).verticalFov, 50.0 / 180.0 * base::kPi, 1e-12);
    scene_.cameras.clear();
    EXPECT_EQ(choose({}).name, "first view");
}

TEST_F(ChooseCamera, UnknownNameListsTheKnown) {
    cli::CameraArguments arguments;
    arguments.name = "roof";
    try {
        choose(arguments);
        FAIL();
    } catch (const base::UsageError& error) {
        EXPECT_EQ(std::string(error.what()), "--camera: the scene has no camera 'roof'; it has door, window");
    }
}

TEST(PictureSize, IsReadStrictly) {
    EXPECT_EQ(app::parseSize("1280x720"), (gl::PixelSize{1280, 720}));
    for (const char* text : {"", "x", "1280", "1280x", "x720", "0x5", "5x0", "-3x4", "3x4x5", "3.5x4",
                             "9x99999", "99999999999x1", " 3x4"}) {
        EXPECT_THROW(app::parseSize(text), base::UsageError) << text;
    }
}

}  // namespace
}  // namespace fluxwalk::render
