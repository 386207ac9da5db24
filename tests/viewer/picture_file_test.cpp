#include "viewer/app/picture_file.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace fluxwalk::app {
namespace {

TEST(PictureFile, KnowsLightByItsName) {
    EXPECT_TRUE(isLightFile("a.exr"));
    EXPECT_TRUE(isLightFile("a.EXR"));
    EXPECT_FALSE(isLightFile("exr.png"));
    EXPECT_FALSE(isLightFile("exr"));
}

TEST(PictureFile, LightHasNoOverlays) {
    LookArguments look;
    EXPECT_NO_THROW(checkPictureFile("a.exr", look));
    look.draw.elementEdges = true;
    EXPECT_NO_THROW(checkPictureFile("a.png", look));
    EXPECT_THROW(checkPictureFile("a.exr", look), base::UsageError);
}

TEST(PictureFile, FindsAFreeName) {
    const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "free-names";
    std::filesystem::create_directories(folder);
    EXPECT_EQ(freePictureName(folder, "a room/1", ".png"), folder / "a-room-1-1.png");
    std::ofstream(folder / "a-room-1-1.png") << "taken";
    EXPECT_EQ(freePictureName(folder, "a room/1", ".png"), folder / "a-room-1-2.png");
    EXPECT_EQ(freePictureName(folder, "", ".exr"), folder / "fluxwalk-1.exr");
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace fluxwalk::app
