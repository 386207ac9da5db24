#include "viewer/render/frustum.h"

#include <gtest/gtest.h>

#include "viewer/render/camera.h"

namespace fluxwalk::render {
namespace {

base::Box boxAt(const base::Vec3d& center, double half) {
    base::Box box;
    box.extend(center - half);
    box.extend(center + half);
    return box;
}

TEST(Frustum, LeavesOutWhatIsNotSeen) {
    const scene::Camera camera = lookAt({0, 0, 0}, {0, 0, -1}, 90.0);
    const Frustum frustum(clipFromWorld(camera, 2.0, {0.1, 100.0}));
    EXPECT_FALSE(frustum.isOutside(boxAt({0, 0, -5}, 1.0)));
    EXPECT_FALSE(frustum.isOutside(boxAt({0, 0, 0}, 1.0)));  // around the eye
    EXPECT_TRUE(frustum.isOutside(boxAt({0, 0, 5}, 1.0)));
    EXPECT_TRUE(frustum.isOutside(boxAt({0, 0, -200}, 1.0)));
    // 45 degrees upwards, 63 to the sides.
    EXPECT_TRUE(frustum.isOutside(boxAt({0, 12.5, -10}, 1.0)));
    EXPECT_FALSE(frustum.isOutside(boxAt({0, 10.5, -10}, 1.0)));
    EXPECT_FALSE(frustum.isOutside(boxAt({20.5, 0, -10}, 1.0)));
    EXPECT_TRUE(frustum.isOutside(boxAt({-23.5, 0, -10}, 1.0)));
}

TEST(Frustum, DistanceToABox) {
    EXPECT_EQ(distanceTo(boxAt({0, 0, 0}, 1.0), {0.5, 0, 0}), 0.0);
    EXPECT_DOUBLE_EQ(distanceTo(boxAt({0, 0, 0}, 1.0), {4.0, 5.0, 0}), 5.0);
}

}  // namespace
}  // namespace fluxwalk::render
