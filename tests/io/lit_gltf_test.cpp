#include "core/io/lit_gltf.h"

#include <cstring>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/io/file.h"
#include "core/io/gltf_container.h"
#include "core/surface/polygon_mesh.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using base::Rgb;
using base::Vec3;
using test::json;

std::shared_ptr<const surface::Surface> square() {
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    return std::make_shared<surface::PolygonMesh>(soup);
}

std::shared_ptr<scene::LitMesh> litSquare(std::uint32_t object, std::uint32_t material, bool back,
                                          std::uint64_t seed) {
    auto mesh = std::make_shared<scene::LitMesh>();
    mesh->object = object;
    mesh->material = material;
    mesh->back = back;
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh->normals.assign(4, Vec3(0, 0, back ? -1 : 1));
    mesh->texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh->triangles =
        back ? std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2} : std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3};
    base::RandomStream random(seed);
    for (int i = 0; i < 4; ++i) {
        mesh->irradiance.emplace_back(1000.0 * random.next(), 1e-3 * random.next(), 1e7 * random.next());
    }
    return mesh;
}

class LitGltf : public testing::Test {
  protected:
    LitGltf() {
        scene_.name = "room";
        scene_.images.push_back({"tiles", 2, 1, {255, 0, 0, 255, 0, 255, 0, 128}});
        scene::Material wall;
        wall.name = "wall";
        wall.reflectance = {0.1f, 0.7f, 0.3f};
        scene::Material tiles;
        tiles.name = "tiles";
        tiles.reflectance = {0.9f, 0.8f, 1.0f};
        tiles.reflectanceTexture.image = 0;
        tiles.reflectanceTexture.wrapU = scene::Wrap::mirror;
        tiles.reflectanceTexture.scale = {2, 3};
        tiles.reflectanceTexture.rotation = 0.5f;
        tiles.alphaMode = scene::AlphaMode::mask;
        tiles.alphaCutoff = 0.3f;
        scene::Material lamp;
        lamp.name = "lamp";
        lamp.reflectance = {0.2f, 0.2f, 0.2f};
        lamp.emission = {3000.0f, 1234.567f, 0.1f};
        lamp.doubleSided = true;
        scene_.materials = {wall, tiles, lamp};
        scene_.objects = {{"wall", square(), 0}, {"floor", square(), 1}, {"lamp", square(), 2}};
        scene_.sky = {1, 2, 3};
        scene::Camera camera;
        camera.name = "door";
        camera.position = {1, 2, 3};
        camera.forward = glm::normalize(base::Vec3d(1, -1, 2));
        camera.up = glm::normalize(base::Vec3d(1, 3, 1));
        camera.verticalFov = 0.77;
        scene_.cameras.push_back(camera);
        meshes_ = {litSquare(0, 0, false, 1), litSquare(0, 0, true, 2), litSquare(1, 1, false, 3),
                   litSquare(2, 2, true, 4)};
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "lit.glb";
    scene::Scene scene_;
    scene::LitMeshes meshes_;
};

TEST_F(LitGltf, RoundTripIsBitwise) {
    io::writeLitGltf(file_, scene_, meshes_, {0.0123f});
    EXPECT_TRUE(io::isLitGltf(file_));
    const io::LitFile back = io::readLitGltf(file_);
    EXPECT_EQ(back.settings.exposure, 0.0123f);
    EXPECT_EQ(back.scene.sky, Rgb(1, 2, 3));
    ASSERT_EQ(back.meshes.size(), meshes_.size());
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const scene::LitMesh& a = *meshes_[i];
        const scene::LitMesh& b = *back.meshes[i];
        EXPECT_EQ(a.object, b.object);
        EXPECT_EQ(a.material, b.material);
        EXPECT_EQ(a.back, b.back);
        EXPECT_EQ(a.positions, b.positions);
        EXPECT_EQ(a.normals, b.normals);
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(a.texcoords[0], b.texcoords[0]);
        ASSERT_EQ(a.irradiance.size(), b.irradiance.size());
        EXPECT_EQ(std::memcmp(a.irradiance.data(), b.irradiance.data(), a.irradiance.size() * sizeof(Rgb)),
                  0);
    }
    ASSERT_EQ(back.scene.objects.size(), 3u);
    EXPECT_EQ(back.scene.objects[1].name, "floor");
    // The lamp has only its back: its surface still faces the front.
    EXPECT_GT(back.scene.objects[2].surface->evaluate(0, {0.3, 0.3}).normal.z, 0.9);
}

TEST_F(LitGltf, RestoresMaterialsAndCameras) {
    io::writeLitGltf(file_, scene_, meshes_, {0.0123f});
    const scene::Scene back = io::readLitGltf(file_).scene;
    ASSERT_EQ(back.materials.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(back.materials[i].name, scene_.materials[i].name);
        EXPECT_EQ(back.materials[i].reflectance, scene_.materials[i].reflectance);
        EXPECT_EQ(back.materials[i].emission, scene_.materials[i].emission);
        EXPECT_EQ(back.materials[i].doubleSided, scene_.materials[i].doubleSided);
        EXPECT_EQ(back.materials[i].alphaMode, scene_.materials[i].alphaMode);
    }
    const scene::TextureRef& texture = back.materials[1].reflectanceTexture;
    ASSERT_TRUE(texture.isSet());
    EXPECT_EQ(texture.wrapU, scene::Wrap::mirror);
    EXPECT_EQ(texture.scale, base::Vec2(2, 3));
    EXPECT_EQ(texture.rotation, 0.5f);
    EXPECT_EQ(back.images[0].rgba, scene_.images[0].rgba);
    ASSERT_EQ(back.cameras.size(), 1u);
    const scene::Camera& a = scene_.cameras[0];
    const scene::Camera& b = back.cameras[0];
    EXPECT_EQ(b.name, "door");
    EXPECT_EQ(b.verticalFov, a.verticalFov);
    EXPECT_LT(glm::distance(a.position, b.position), 1e-12);
    EXPECT_LT(glm::distance(a.forward, b.forward), 1e-12);
    const base::Vec3d up = glm::normalize(a.up - glm::dot(a.up, a.forward) * a.forward);
    EXPECT_LT(glm::distance(up, b.up), 1e-12);
}

// Floats of an accessor, straight from the file's bytes.
std::vector<float> floatsOf(const io::GltfContainer& file, const json& root, int accessor) {
    const json& a = root["accessors"][static_cast<std::size_t>(accessor)];
    const json& view = root["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t start =
        file.bytes.size() - file.binaryChunkBytes + view["byteOffset"].get<std::size_t>();
    std::vector<float> values(view["byteLength"].get<std::size_t>() / sizeof(float));
    std::memcpy(values.data(), file.bytes.data() + start, values.size() * sizeof(float));
    return values;
}

TEST_F(LitGltf, ColoursAreExposedLight) {
    const float exposure = 0.0004f;
    io::writeLitGltf(file_, scene_, meshes_, {exposure});
    const io::GltfContainer container = io::openGltf(file_);
    const json root = json::parse(container.json);
    const auto colorsOf = [&](std::size_t mesh, std::size_t primitive) {
        const json& p = root["meshes"][mesh]["primitives"][primitive];
        return floatsOf(container, root, p["attributes"]["COLOR_0"].get<int>());
    };
    const auto clamped = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
    const std::vector<float> wall = colorsOf(0, 1);
    const std::vector<float> floor = colorsOf(1, 0);
    const std::vector<float> lamp = colorsOf(2, 0);
    ASSERT_EQ(wall.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) {
        const auto c = static_cast<int>(i % 3);
        const std::size_t v = i / 3;
        EXPECT_FLOAT_EQ(
            wall[i], clamped(exposure * meshes_[1]->irradiance[v][c] * scene_.materials[0].reflectance[c]));
        // The viewer multiplies by the texture.
        EXPECT_FLOAT_EQ(
            floor[i], clamped(exposure * meshes_[2]->irradiance[v][c] * scene_.materials[1].reflectance[c]));
        EXPECT_FLOAT_EQ(lamp[i], clamped(exposure * (meshes_[3]->irradiance[v][c] * 0.2f +
                                                     scene_.materials[2].emission[c])));
    }
    for (const json& material : root["materials"]) {
        EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
        EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"], json({1.0, 1.0, 1.0, 1.0}));
    }
    EXPECT_TRUE(root["materials"][1]["pbrMetallicRoughness"].contains("baseColorTexture"));
    EXPECT_EQ(root["images"][0]["mimeType"], "image/png");
    EXPECT_TRUE(root["asset"]["extras"].contains("fluxwalk_units"));
}

TEST_F(LitGltf, OrdinaryReadersAcceptTheFile) {
    io::writeLitGltf(file_, scene_, meshes_, {0.01f});
    const scene::Scene scene = io::readGltf(file_);
    EXPECT_EQ(scene.objects.size(), 4u);
    EXPECT_FALSE(test::hasWarning(scene, "not supported and ignored"));
}

TEST_F(LitGltf, ExposureMapsThePercentileOfTheExitance) {
    // 19 dim squares to one bright one, all with reflectance 0.5: 95 % of the area is at most 100 lm/m2.
    scene_.materials[0].reflectance = Rgb(0.5f);
    meshes_.clear();
    for (int i = 0; i < 20; ++i) {
        auto mesh = litSquare(0, 0, false, 1);
        mesh->irradiance.assign(4, Rgb(i < 19 ? 200.0f : 1e6f));
        meshes_.push_back(mesh);
    }
    EXPECT_NEAR(io::chooseExposure(scene_, meshes_), 0.9f / 100.0f, 1e-7f);
    for (auto& mesh : meshes_) {
        auto dark = std::make_shared<scene::LitMesh>(*mesh);
        dark->irradiance.assign(4, Rgb(0.0f));
        mesh = dark;
    }
    EXPECT_EQ(io::chooseExposure(scene_, meshes_), 1.0f);
}

TEST_F(LitGltf, KeepsTheOldFileWhereItCannotWrite) {
    EXPECT_THROW(io::writeLitGltf(folder_.path() / "missing" / "lit.glb", scene_, meshes_, {}),
                 base::FileError);
    EXPECT_THROW(io::writeLitGltf(folder_.path(), scene_, meshes_, {}), base::FileError);
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(LitGltf, RefusesOtherFilesAndDamage) {
    test::GltfFixture other;
    other.addNode({{"mesh", other.addSquare()}});
    test::writeBytes(file_, other.glb());
    EXPECT_FALSE(io::isLitGltf(file_));
    EXPECT_FALSE(io::isLitGltf(folder_.path() / "missing.glb"));
    EXPECT_THROW(io::readLitGltf(file_), base::FileError);

    io::writeLitGltf(file_, scene_, meshes_, {0.01f});
    const std::vector<std::uint8_t> whole = io::readFile(file_);
    base::RandomStream random(99);
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<std::uint8_t> bytes = whole;
        for (int i = 0; i < 3; ++i) {
            bytes[static_cast<std::size_t>(random.next() * static_cast<double>(bytes.size()))] =
                static_cast<std::uint8_t>(random.next() * 256.0);
        }
        test::writeBytes(file_, bytes);
        try {
            const io::LitFile read = io::readLitGltf(file_);
            EXPECT_FALSE(read.meshes.empty());
        } catch (const base::FileError& e) {
            EXPECT_FALSE(std::string(e.what()).empty());
        }
    }
}

}  // namespace
}  // namespace fluxwalk
