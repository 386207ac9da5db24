#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using base::Vec3d;
using test::GltfFixture;
using test::json;

class GltfScene : public testing::Test {
  protected:
    scene::Scene read() { return fixture_.read(folder_); }

    static double areaOf(const scene::Object& object) {
        double area = 0.0;
        for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
            area += object.surface->area(p, surface::wholePatch(object.surface->domain(p)));
        }
        return area;
    }
    static Vec3d normalOf(const scene::Object& object) {
        return object.surface->evaluate(0, {0.25, 0.25}).normal;
    }
    static void expectNear(const Vec3d& a, const Vec3d& b, double tolerance = 1e-6) {
        EXPECT_LT(glm::distance(a, b), tolerance)
            << a.x << ' ' << a.y << ' ' << a.z << " vs " << b.x << ' ' << b.y << ' ' << b.z;
    }

    test::TemporaryFolder folder_;
    GltfFixture fixture_;
};

TEST_F(GltfScene, ReadsASquareAsOneQuad) {
    fixture_.addNode({{"name", "square"}, {"mesh", fixture_.addSquare()}});
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "square");
    EXPECT_EQ(scene.objects[0].surface->patchCount(), 1u);
    EXPECT_DOUBLE_EQ(areaOf(scene.objects[0]), 1.0);
    expectNear(normalOf(scene.objects[0]), {0, 0, 1});
    EXPECT_TRUE(test::hasWarning(scene, "no material"));
}

TEST_F(GltfScene, ReadsTextFilesWithExternalAndEmbeddedBuffers) {
    fixture_.addNode({{"mesh", fixture_.addSquare()}});
    test::writeBytes(folder_.path() / "data 1.bin", fixture_.bin);
    fixture_.root["buffers"] = {{{"byteLength", fixture_.bin.size()}, {"uri", "data%201.bin"}}};
    const auto file = folder_.path() / "scene.gltf";
    test::writeBytes(file, test::bytesOf(fixture_.root.dump()));
    EXPECT_EQ(io::readGltf(file).objects.size(), 1u);

    // Four bytes "AAECAw==" are 0 1 2 3: a buffer in the file itself.
    GltfFixture embedded;
    embedded.root["buffers"] = {
        {{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,AAECAw=="}}};
    embedded.add("bufferViews", {{"buffer", 0}, {"byteLength", 4}});
    embedded.addAccessor(0, 5121, 4, "SCALAR");
    test::writeBytes(file, test::bytesOf(embedded.root.dump()));
    EXPECT_NE(test::errorOf(file).find("no surface"), std::string::npos);
}

TEST_F(GltfScene, ReadsStripsAndFansWithTheirWinding) {
    const int positions = fixture_.addPositions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const int fan = fixture_.addPositions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    fixture_.addNode({{"mesh", fixture_.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}})}});
    fixture_.addNode({{"mesh", fixture_.addMesh({{"attributes", {{"POSITION", fan}}}, {"mode", 6}})}});
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 2u);
    for (const scene::Object& object : scene.objects) {
        EXPECT_DOUBLE_EQ(areaOf(object), 1.0);
        for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
            expectNear(object.surface->evaluate(p, {0.3, 0.3}).normal, {0, 0, 1});
        }
    }
}

TEST_F(GltfScene, ReadsEveryIndexType) {
    const int positions = fixture_.addPositions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const std::vector<int> accessors{
        fixture_.addAccessor(fixture_.addView(std::vector<std::uint8_t>{0, 1, 2}), 5121, 3, "SCALAR"),
        fixture_.addAccessor(fixture_.addView(std::vector<std::uint16_t>{0, 1, 2}), 5123, 3, "SCALAR"),
        fixture_.addAccessor(fixture_.addView(std::vector<std::uint32_t>{0, 1, 2}), 5125, 3, "SCALAR")};
    for (const int indices : accessors) {
        fixture_.addNode(
            {{"mesh", fixture_.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
    }
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 3u);
    for (const scene::Object& object : scene.objects) {
        EXPECT_DOUBLE_EQ(areaOf(object), 0.5);
    }
}

TEST_F(GltfScene, KeepsOnlyTheVerticesInUse) {
    std::vector<float> many(3000, 0.0f);
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::copy(corners.begin(), corners.end(), many.begin() + 600);
    fixture_.addNode({{"mesh", fixture_.addMesh({{"attributes", {{"POSITION", fixture_.addPositions(many)}}},
                                                 {"indices", fixture_.addIndices({200, 201, 202})}})}});
    const scene::Scene scene = read();
    EXPECT_EQ(scene.objects.at(0).surface->triangles().positions.size(), 3u);
    EXPECT_DOUBLE_EQ(areaOf(scene.objects[0]), 0.5);
}

TEST_F(GltfScene, PlacesMeshesThroughTheHierarchy) {
    const int mesh = fixture_.addSquare();
    // Child: turned a quarter about x, so that +z becomes -y; parent: moved and scaled by a matrix.
    const double h = std::sqrt(0.5);
    fixture_.addNode({{"name", "parent"},
                      {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1}},
                      {"children", {1, 2}}});
    fixture_.addNode(
        {{"name", "turned"}, {"mesh", mesh}, {"rotation", {h, 0, 0, h}}, {"translation", {1, 0, 0}}});
    fixture_.addNode({{"name", "scaled"}, {"mesh", mesh}, {"scale", {3, 1, 1}}});
    fixture_.root["scenes"] = {{{"nodes", {0}}}};
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "turned");
    expectNear(normalOf(scene.objects[0]), {0, -1, 0});
    EXPECT_NEAR(areaOf(scene.objects[0]), 4.0, 1e-6);
    expectNear(scene.objects[0].surface->bounds().lower, {12, 20, 30}, 1e-5);
    expectNear(scene.objects[0].surface->bounds().upper, {14, 20, 32}, 1e-5);
    EXPECT_NEAR(areaOf(scene.objects[1]), 12.0, 1e-6);
}

TEST_F(GltfScene, KeepsTheFrontOfMirroredNodes) {
    fixture_.addNode({{"mesh", fixture_.addSquare()}, {"scale", {-1, 1, 1}}});
    expectNear(normalOf(read().objects.at(0)), {0, 0, 1});
}

TEST_F(GltfScene, MakesNamesUnique) {
    const int mesh = fixture_.addSquare();
    json& primitives = fixture_.root["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    fixture_.addNode({{"name", "wall"}, {"mesh", mesh}});
    fixture_.addNode({{"name", "wall"}, {"mesh", mesh}});
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_EQ(scene.objects[0].name, "wall/0");
    EXPECT_EQ(scene.objects[1].name, "wall/1");
    EXPECT_EQ(scene.objects[2].name, "wall/0#2");
    EXPECT_EQ(scene.objects[3].name, "wall/1#2");
}

TEST_F(GltfScene, ManyNodesMayShareAName) {
    const int mesh = fixture_.addSquare();
    for (int i = 0; i < 3; ++i) {
        fixture_.addNode({{"name", i == 1 ? "chair#2" : "chair"}, {"mesh", mesh}});
    }
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[1].name, "chair#2");
    EXPECT_EQ(scene.objects[2].name, "chair#3");
}

TEST_F(GltfScene, ReadsOnlyItsScene) {
    const int mesh = fixture_.addSquare();
    fixture_.addNode({{"name", "a"}, {"mesh", mesh}});
    fixture_.addNode({{"name", "b"}, {"mesh", mesh}});
    fixture_.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    EXPECT_EQ(read().objects.at(0).name, "a");
    fixture_.root["scene"] = 1;
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "b");
}

TEST_F(GltfScene, DropsAndCountsTrianglesWithoutArea) {
    const int positions = fixture_.addPositions({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0});
    fixture_.addNode(
        {{"mesh", fixture_.addMesh({{"attributes", {{"POSITION", positions}}},
                                    {"indices", fixture_.addIndices({0, 1, 2, 0, 1, 3, 1, 1, 2})}})}});
    const scene::Scene scene = read();
    EXPECT_EQ(scene.droppedTriangleCount, 2u);
    EXPECT_TRUE(test::hasWarning(scene, "2 triangles without area were dropped"));
    EXPECT_EQ(scene.objects.at(0).surface->triangles().triangles.size(), 1u);
}

TEST_F(GltfScene, ReadsCameras) {
    fixture_.addNode({{"mesh", fixture_.addSquare()}});
    fixture_.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.2}}}});
    fixture_.add("cameras", {{"type", "orthographic"},
                             {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 10}, {"znear", 0.1}}}});
    const double h = std::sqrt(0.5);
    // A quarter turn about y: -z becomes -x.
    fixture_.addNode(
        {{"name", "door"}, {"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}});
    fixture_.addNode({{"camera", 1}});
    const scene::Scene scene = read();
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "door");
    expectNear(scene.cameras[0].position, {1, 2, 3});
    expectNear(scene.cameras[0].forward, {-1, 0, 0});
    expectNear(scene.cameras[0].up, {0, 1, 0});
    EXPECT_DOUBLE_EQ(scene.cameras[0].verticalFov, 0.7);
    EXPECT_DOUBLE_EQ(scene.cameras[0].nearPlane, 0.2);
    EXPECT_TRUE(test::hasWarning(scene, "not perspective"));
}

TEST_F(GltfScene, ReadsPunctualLights) {
    fixture_.addNode({{"mesh", fixture_.addSquare()}});
    fixture_.root["extensionsUsed"] = {"KHR_lights_punctual"};
    fixture_.root["extensionsRequired"] = {"KHR_lights_punctual"};
    fixture_.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"color", {1.0, 0.5, 0.25}}, {"intensity", 100}, {"range", 5}},
        {{"type", "spot"},
         {"intensity", 40},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}},
         {"name", "beam"}},
        {{"type", "directional"}, {"intensity", 90000}},
        {{"type", "laser"}}};
    for (int i = 0; i < 4; ++i) {
        fixture_.addNode({{"translation", {0, i, 0}},
                          {"scale", {2, 2, 2}},
                          {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    const scene::Scene scene = read();
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].kind, scene::LightKind::point);
    EXPECT_EQ(scene.lights[0].intensity, base::Rgb(100, 50, 25));
    EXPECT_DOUBLE_EQ(scene.lights[0].range, 5.0);
    EXPECT_NEAR(scene::fluxOf(scene.lights[0]).r, 400.0 * base::kPi, 1e-3);
    EXPECT_EQ(scene.lights[1].kind, scene::LightKind::spot);
    EXPECT_EQ(scene.lights[1].name, "beam");
    EXPECT_DOUBLE_EQ(scene.lights[1].innerConeAngle, 0.2);
    EXPECT_DOUBLE_EQ(scene.lights[1].outerConeAngle, 0.4);
    expectNear(scene.lights[1].position, {0, 1, 0});
    expectNear(scene.lights[2].direction, {0, 0, -1});
    EXPECT_TRUE(test::hasWarning(scene, "range"));
    EXPECT_TRUE(test::hasWarning(scene, "'laser' is not known"));
}

TEST_F(GltfScene, ReadsASphereInsteadOfItsStandIn) {
    const int mesh = fixture_.addMesh(
        {{"attributes", {{"POSITION", fixture_.addPositions({-3, -1, -1, 3, 1, -1, 0, 1, 1})}}}});
    fixture_.addNode({{"mesh", mesh},
                      {"translation", {1, 2, 3}},
                      {"scale", {2, 2, 2}},
                      {"extras", {{"fluxwalk_surface", "sphere"}, {"fluxwalk_radius", 0.5}}}});
    fixture_.addNode(
        {{"mesh", mesh}, {"extras", {{"fluxwalk_surface", "sphere"}, {"fluxwalk_inside", true}}}});
    fixture_.addNode({{"mesh", mesh}, {"extras", {{"fluxwalk_surface", "teapot"}}}});
    const scene::Scene scene = read();
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[0].surface->kind(), "sphere");
    EXPECT_NEAR(areaOf(scene.objects[0]), 4.0 * base::kPi, 1e-9);
    expectNear(scene.objects[0].surface->bounds().center(), {1, 2, 3});
    // Without a radius: half the longest side of the stand-in's bounds, 3.
    EXPECT_NEAR(areaOf(scene.objects[1]), 36.0 * base::kPi, 1e-9);
    const surface::SurfacePoint point = scene.objects[1].surface->evaluate(0, {0.3, 0.3});
    EXPECT_LT(glm::dot(point.normal, point.position), 0.0);
    EXPECT_EQ(scene.objects[2].surface->kind(), "polygon mesh");
    EXPECT_TRUE(test::hasWarning(scene, "fluxwalk_surface 'teapot' is not supported"));
}

TEST_F(GltfScene, NamesWhatItCannotExpress) {
    fixture_.addNode({{"mesh", fixture_.addSquare()}});
    const int points =
        fixture_.addMesh({{"attributes", {{"POSITION", fixture_.addPositions({0, 0, 0})}}}, {"mode", 0}});
    fixture_.addNode({{"mesh", points}});
    fixture_.addNode({{"mesh", points}});
    fixture_.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "KHR_materials_clearcoat"};
    const scene::Scene scene = read();
    EXPECT_EQ(scene.objects.size(), 1u);
    EXPECT_TRUE(test::hasWarning(scene, "points and lines have no surface; left out (and 1 more)"));
    EXPECT_TRUE(test::hasWarning(scene, "EXT_mesh_gpu_instancing is not supported"));
    EXPECT_TRUE(test::hasWarning(scene, "KHR_materials_clearcoat is not supported"));
}

}  // namespace
}  // namespace fluxwalk
