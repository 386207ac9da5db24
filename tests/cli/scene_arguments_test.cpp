#include "core/cli/scene_arguments.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace fluxwalk::cli {
namespace {

SceneArguments argumentsFor(const char* scene, double sky = -1.0) {
    SceneArguments arguments;
    arguments.scene = scene;
    arguments.sky = sky;
    return arguments;
}

TEST(SceneArguments, FilesAreToldFromNames) {
    EXPECT_TRUE(namesFile("room.glb"));
    EXPECT_TRUE(namesFile("Room.GLTF"));
    EXPECT_TRUE(namesFile("scenes/room"));
    EXPECT_TRUE(namesFile(FLUXWALK_SOURCE_DIR "/CMakeLists.txt"));
    EXPECT_FALSE(namesFile("cornell-box"));
}

TEST(SceneArguments, BuiltInScenesLoadByName) {
    const scene::Scene scene = loadScene(argumentsFor("cornell-box"));
    EXPECT_FALSE(scene.objects.empty());
    EXPECT_EQ(scene.sky, scene::Rgb(0.0f)) << "it has a lamp of its own";
}

TEST(SceneArguments, SkyIsTheUsersChoice) {
    EXPECT_EQ(loadScene(argumentsFor("cornell-box", 250.0)).sky, scene::Rgb(250.0f));
    EXPECT_EQ(loadScene(argumentsFor("cornell-box", 0.0)).sky, scene::Rgb(0.0f));
}

TEST(SceneArguments, UnknownNamesSuggestTheNearest) {
    try {
        loadScene(argumentsFor("cornel-box"));
        FAIL();
    } catch (const base::UsageError& error) {
        EXPECT_STREQ(
            error.what(),
            "unknown scene 'cornel-box': neither a file nor a built-in scene; did you mean 'cornell-box'?");
    }
}

TEST(SceneArguments, MissingFilesAreBadInput) {
    EXPECT_THROW(loadScene(argumentsFor("no/such/room.glb")), base::FileError);
}

}  // namespace
}  // namespace fluxwalk::cli
