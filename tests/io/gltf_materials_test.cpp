#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/io/image_write.h"
#include "core/scene/texture.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using test::GltfFixture;
using test::json;

class GltfMaterials : public testing::Test {
  protected:
    scene::Scene read(const json& material) {
        const int index = fixture_.add("materials", material);
        fixture_.addNode({{"mesh", fixture_.addSquare({{"material", index}})}});
        return fixture_.read(folder_);
    }

    static std::vector<std::uint8_t> png(std::uint8_t r, std::uint8_t g, std::uint8_t b,
                                         std::uint8_t a = 255) {
        return io::encodePng(1, 1, 4, std::vector<std::uint8_t>{r, g, b, a});
    }

    test::TemporaryFolder folder_;
    GltfFixture fixture_;
};

TEST_F(GltfMaterials, ReadsFactors) {
    const scene::Scene scene =
        read({{"name", "paint"},
              {"doubleSided", true},
              {"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.6, 0.5}}, {"metallicFactor", 0}}},
              {"emissiveFactor", {1.0, 0.5, 0.0}},
              {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 100.0}}}}}});
    const scene::Material& m = scene.materials.at(0);
    EXPECT_EQ(m.name, "paint");
    EXPECT_EQ(m.reflectance, base::Rgb(0.2f, 0.4f, 0.6f));
    EXPECT_TRUE(m.doubleSided);
    EXPECT_FLOAT_EQ(m.emission.r, static_cast<float>(100.0 * base::kPi));
    EXPECT_FLOAT_EQ(m.emission.g, static_cast<float>(50.0 * base::kPi));
    EXPECT_EQ(m.emission.b, 0.0f);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST_F(GltfMaterials, ClampsReflectanceAndSaysSo) {
    const scene::Scene scene =
        read({{"name", "snow"},
              {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 0.5, 1}}, {"metallicFactor", 0}}}});
    EXPECT_EQ(scene.materials[0].reflectance,
              base::Rgb(scene::kMaxReflectance, scene::kMaxReflectance, 0.5f));
    EXPECT_TRUE(test::hasWarning(scene, "/materials/0 'snow': the reflectance exceeds 0.98; clamped"));
}

TEST_F(GltfMaterials, ClampsTexelsNotTheWholeTexture) {
    const int texture = fixture_.addTexture(
        io::encodePng(2, 1, 4, std::vector<std::uint8_t>{255, 255, 255, 255, 128, 128, 128, 255}));
    const scene::Scene scene =
        read({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}}}});
    EXPECT_TRUE(test::hasWarning(scene, "the reflectance exceeds 0.98"));
    EXPECT_EQ(scene.materials[0].reflectance, base::Rgb(1.0f));
    const scene::TextureSet textures(scene);
    const auto at = [&](double u) {
        return scene::pointMaterial(scene, textures, scene.objects[0], 0,
                                    scene.objects[0].surface->locate(0, {u, 0.5, 0.0}))
            .reflectance.r;
    };
    EXPECT_EQ(at(0.25), scene::kMaxReflectance);
    EXPECT_NEAR(at(0.75), base::linearFromSrgb(128.0 / 255.0), 1e-6);
}

TEST_F(GltfMaterials, WarnsOfMetalsAndKeepsTheirAlbedo) {
    const scene::Scene scene =
        read({{"name", "brass"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.7, 0.6, 0.3, 1}}}}});
    EXPECT_EQ(scene.materials[0].reflectance, base::Rgb(0.7f, 0.6f, 0.3f));
    EXPECT_TRUE(test::hasWarning(scene, "'brass': a metal is treated as diffuse"));
}

TEST_F(GltfMaterials, ReadsTexturesWithSamplersSetsAndTransforms) {
    fixture_.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    const int texture = fixture_.addTexture(png(255, 0, 0), {{"sampler", 0}});
    const scene::Scene scene =
        read({{"pbrMetallicRoughness",
               {{"baseColorTexture",
                 {{"index", texture},
                  {"texCoord", 0},
                  {"extensions",
                   {{"KHR_texture_transform",
                     {{"offset", {0.1, 0.2}}, {"scale", {2, 3}}, {"rotation", 0.5}, {"texCoord", 1}}}}}}},
                {"metallicFactor", 0}}}});
    const scene::TextureRef& t = scene.materials[0].reflectanceTexture;
    EXPECT_EQ(t.image, 0);
    EXPECT_EQ(t.texcoordSet, 1);
    EXPECT_EQ(t.wrapU, scene::Wrap::clamp);
    EXPECT_EQ(t.wrapV, scene::Wrap::mirror);
    EXPECT_EQ(t.offset, base::Vec2(0.1f, 0.2f));
    EXPECT_EQ(t.scale, base::Vec2(2.0f, 3.0f));
    EXPECT_EQ(t.rotation, 0.5f);
    EXPECT_TRUE(test::hasWarning(scene, "has no TEXCOORD_1"));
}

TEST_F(GltfMaterials, ReadsAlphaModes) {
    const scene::Scene mask = read(
        {{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    EXPECT_EQ(mask.materials[0].alphaMode, scene::AlphaMode::mask);
    EXPECT_EQ(mask.materials[0].alphaCutoff, 0.25f);
    fixture_ = {};
    const scene::Scene blend = read({{"alphaMode", "BLEND"}});
    EXPECT_EQ(blend.materials[0].alphaMode, scene::AlphaMode::blend);
    EXPECT_TRUE(test::hasWarning(blend, "a blended material does not block light"));
    fixture_ = {};
    const scene::Scene glass =
        read({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}}}});
    EXPECT_EQ(glass.materials[0].alphaMode, scene::AlphaMode::blend);
    EXPECT_TRUE(test::hasWarning(glass, "KHR_materials_transmission"));
    fixture_ = {};
    EXPECT_TRUE(test::hasWarning(read({{"extensions", {{"KHR_materials_unlit", json::object()}}}}),
                                 "KHR_materials_unlit"));
}

TEST_F(GltfMaterials, TurnsMissingAndDamagedImagesGrey) {
    std::vector<std::uint8_t> truncated = png(1, 2, 3);
    truncated.resize(40);
    const int damaged = fixture_.addTexture(truncated);
    fixture_.add("images", {{"uri", "missing.png"}});
    const int missing = fixture_.add("textures", {{"source", 1}});
    const int webp = fixture_.add("textures", json{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    for (const int texture : {damaged, missing, webp}) {
        GltfFixture copy = fixture_;
        copy.add("materials", {{"pbrMetallicRoughness",
                                {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}}}});
        copy.addNode({{"mesh", copy.addSquare({{"material", 0}})}});
        const scene::Scene scene = copy.read(folder_);
        EXPECT_TRUE(test::hasWarning(scene, "mid grey is used instead"));
        const scene::TextureSet textures(scene);
        EXPECT_NEAR(scene::pointMaterial(scene, textures, scene.objects[0], 0, {0.5, 0.5}).reflectance.g,
                    0.5f, 0.005f);
    }
}

TEST_F(GltfMaterials, DecodesOnlyImagesInUseAndEachOnce) {
    const int used = fixture_.addTexture(png(10, 20, 30));
    fixture_.addTexture({1, 2, 3, 4});  // would be a warning if it were decoded
    const scene::Scene scene =
        read({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", used}}}, {"metallicFactor", 0}}},
              {"emissiveFactor", {1, 1, 1}},
              {"emissiveTexture", {{"index", used}}}});
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{10, 20, 30, 255}));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST_F(GltfMaterials, ReducesSixteenBitPicturesToEight) {
    // PNG of one 16-bit grey pixel of value 0x8001, made by hand: signature, IHDR, IDAT (stored block), IEND.
    const std::vector<std::uint8_t> grey16{
        0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,   13,   'I',  'H',  'D',
        'R',  0,    0,    0,    1,    0,    0,    0,    1,    16,   0,   0,    0,    0,    0x6a,
        0xee, 0x47, 0x16, 0,    0,    0,    14,   'I',  'D',  'A',  'T', 0x78, 0x01, 0x01, 0x03,
        0x00, 0xfc, 0xff, 0x00, 0x80, 0x01, 0x01, 0x04, 0x00, 0x82, 0,   0,    0,    0,    0,
        0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
    const int texture = fixture_.addTexture(grey16);
    const scene::Scene scene =
        read({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}}}});
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{0x80, 0x80, 0x80, 255}));
}

TEST_F(GltfMaterials, RefusesPicturesOfAbsurdSize) {
    // A PNG header that claims 30000 x 30000 pixels (3.6 GB decoded) over a few bytes.
    std::vector<std::uint8_t> bomb = io::encodePng(1, 1, 1, std::vector<std::uint8_t>{7});
    bomb[18] = bomb[22] = 0x75;
    bomb[19] = bomb[23] = 0x30;
    const int texture = fixture_.addTexture(bomb);
    const scene::Scene scene =
        read({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}}}});
    EXPECT_TRUE(test::hasWarning(scene, "too large (30000 x 30000)"));
}

}  // namespace
}  // namespace fluxwalk
