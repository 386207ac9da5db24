#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/io/gltf_read.h"
#include "core/scene/describe.h"

namespace fluxwalk {
namespace {

// Scenes made by others, beside the project's folder; never part of it.
std::filesystem::path sceneFile(const char* name) {
    return std::filesystem::path(FLUXWALK_SHARED_SCENES) / name;
}

scene::SceneDescription describe(const char* name) {
    const scene::Scene scene = io::readGltf(sceneFile(name));
    return scene::describeScene(scene, scene::TextureSet(scene));
}

struct Expected {
    const char* file;
    std::size_t triangles;
    std::size_t emittingPatches;
    double lumens;
    double tolerance;
};

class RealScene : public testing::TestWithParam<Expected> {};

TEST_P(RealScene, IsDescribedAsItsReadmeSays) {
    const Expected& expected = GetParam();
    if (!std::filesystem::exists(sceneFile(expected.file))) {
        GTEST_SKIP() << expected.file << " is not in " << FLUXWALK_SHARED_SCENES;
    }
    const scene::SceneDescription d = describe(expected.file);
    EXPECT_EQ(d.triangles + d.droppedTriangles, expected.triangles);
    ASSERT_EQ(d.emitters.size(), 1u);
    EXPECT_EQ(d.emitters[0].patches, expected.emittingPatches);
    EXPECT_NEAR(d.lumens, expected.lumens, expected.tolerance);
    EXPECT_EQ(d.cameras.size(), 1u);
}

// The twelve panels of the conference room are one object.
INSTANTIATE_TEST_SUITE_P(Shared, RealScene,
                         testing::Values(Expected{"cornell-box.glb", 36, 1, 7.0, 0.05},
                                         Expected{"conference.glb", 124643, 12, 54287.0, 0.5},
                                         Expected{"veach-ajar.glb", 382690, 1, 12129.0, 0.5},
                                         Expected{"bathroom.glb", 592188, 1, 246.0, 0.5}),
                         [](const auto& scene) {
                             std::string name = scene.param.file;
                             name = name.substr(0, name.find('.'));
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace fluxwalk
