#include <gtest/gtest.h>

#include "core/surface/region.h"
#include "core/surface/subdivision_surface.h"
#include "tests/io/gltf_fixture.h"
#include "tests/surface/cages.h"

namespace fluxwalk {
namespace {

using base::Vec3d;
using test::GltfFixture;
using test::json;

double areaOf(const surface::Surface& surface) {
    double area = 0.0;
    for (std::uint32_t p = 0; p < surface.patchCount(); ++p) {
        area += surface.area(p, surface::wholePatch(surface.domain(p)));
    }
    return area;
}

/// A cage as exporters write it: each polygon has vertices of its own and is a fan of triangles.
struct Exported {
    std::vector<float> positions;
    std::vector<float> texcoords;
    std::vector<std::uint16_t> indices;
};

Exported exportCage(const surface::ControlCage& cage) {
    Exported out;
    std::size_t first = 0;
    for (const std::uint32_t count : cage.faceSizes) {
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vec3d& p = cage.positions[cage.corners[first + k]];
            for (int axis = 0; axis < 3; ++axis) {
                out.positions.push_back(static_cast<float>(p[axis]));
            }
            out.texcoords.push_back(k == 1 || k == 2 ? 1.0f : 0.0f);
            out.texcoords.push_back(k >= 2 ? 1.0f : 0.0f);
            if (k >= 2) {
                for (const std::size_t v : {first, first + k - 1, first + k}) {
                    out.indices.push_back(static_cast<std::uint16_t>(v));
                }
            }
        }
        first += count;
    }
    return out;
}

class GltfCage : public testing::Test {
  protected:
    json primitiveOf(const Exported& cage) {
        return {{"attributes",
                 {{"POSITION", fixture_.addPositions(cage.positions)},
                  {"TEXCOORD_0", fixture_.addTexcoords(cage.texcoords)}}},
                {"indices", fixture_.addIndices(cage.indices)}};
    }
    void addCage(const surface::ControlCage& cage, const json& extras, bool encoded = false,
                 const json& more = json::object()) {
        json primitive = primitiveOf(exportCage(cage));
        if (encoded) {
            primitive["extensions"]["FB_ngon_encoding"] = json::object();
        }
        json node = {{"name", "cage"}, {"mesh", fixture_.addMesh(primitive)}, {"extras", extras}};
        node.update(more);
        fixture_.addNode(node);
    }
    scene::Scene read() { return fixture_.read(folder_); }
    const surface::Surface& readOne() {
        scene_ = read();
        EXPECT_EQ(scene_.objects.size(), 1u);
        return *scene_.objects.at(0).surface;
    }

    test::TemporaryFolder folder_;
    GltfFixture fixture_;
    scene::Scene scene_;
};

const json kCatmullClark = {{"fluxwalk_subdivision", "catmullClark"}};

TEST_F(GltfCage, PlanarQuadsAreFoundAndVerticesWelded) {
    addCage(test::cubeCage(), kCatmullClark);
    const surface::Surface& cube = readOne();
    EXPECT_EQ(cube.kind(), "subdivision surface");
    EXPECT_EQ(cube.patchCount(), 6u);
    EXPECT_NEAR(areaOf(cube), areaOf(surface::SubdivisionSurface(test::cubeCage())), 1e-9);
}

// In any order: the longest common edge of two triangles of a square is its diagonal.
TEST_F(GltfCage, TrianglesOutOfOrderAreStillPaired) {
    Exported cube = exportCage(test::cubeCage());
    std::vector<std::uint16_t> shuffled;
    for (std::size_t i = 0; i < 12; ++i) {
        const std::size_t from = 3 * (i * 5 % 12);
        for (std::size_t k = 0; k < 3; ++k) {
            shuffled.push_back(cube.indices[from + (k + i) % 3]);
        }
    }
    cube.indices = shuffled;
    fixture_.addNode({{"mesh", fixture_.addMesh(primitiveOf(cube))}, {"extras", kCatmullClark}});
    EXPECT_EQ(readOne().patchCount(), 6u);
}

TEST_F(GltfCage, EncodedPolygonsAreKept) {
    addCage(test::mixedCage(), kCatmullClark, true);
    const surface::Surface& mixed = readOne();
    // Five sub-faces of the pentagon, five quads, three sub-faces of each of five triangles.
    EXPECT_EQ(mixed.patchCount(), 25u);
    EXPECT_TRUE(scene_.warnings.empty() || !test::hasWarning(scene_, "triangles of the control cage"));
    surface::ControlCage smooth = test::mixedCage();
    smooth.creases.clear();
    EXPECT_NEAR(areaOf(mixed), areaOf(surface::SubdivisionSurface(smooth)), 1e-5);
}

TEST_F(GltfCage, MirroredNodesKeepTheirFront) {
    for (const bool encoded : {false, true}) {
        fixture_ = {};
        addCage(test::cubeCage(), kCatmullClark, encoded,
                {{"scale", {-1, 2, 1}}, {"translation", {5, 0, 0}}});
        const surface::Surface& cube = readOne();
        ASSERT_EQ(cube.patchCount(), 6u);
        for (std::uint32_t patch = 0; patch < 6; ++patch) {
            const surface::SurfacePoint p = cube.evaluate(patch, {.5, .5});
            EXPECT_GT(glm::dot(p.normal, p.position - Vec3d(5, 0, 0)), 0.0);
        }
    }
}

TEST_F(GltfCage, TrianglesWithoutPartnerAreNamed) {
    addCage(test::mixedCage(), kCatmullClark);
    scene_ = read();
    EXPECT_TRUE(test::hasWarning(scene_, "triangles of the control cage make no planar quads"));
}

TEST_F(GltfCage, LoopTakesTriangles) {
    addCage(test::octahedronCage(), {{"fluxwalk_subdivision", "loop"}});
    const surface::Surface& surface = readOne();
    EXPECT_EQ(surface.patchCount(), 8u);
    EXPECT_EQ(surface.domain(0), surface::PatchDomain::triangle);
    EXPECT_NEAR(areaOf(surface), areaOf(surface::SubdivisionSurface(test::octahedronCage())), 1e-9);
}

// With all edges sharp the cube stays a cube; beyond 90 degrees none is.
TEST_F(GltfCage, CreaseAngle) {
    addCage(test::cubeCage(), {{"fluxwalk_subdivision", "catmullClark"}, {"fluxwalk_crease_angle", 60.0}});
    EXPECT_NEAR(areaOf(readOne()), 24.0, 1e-9);
    fixture_ = {};
    addCage(test::cubeCage(), {{"fluxwalk_subdivision", "catmullClark"}, {"fluxwalk_crease_angle", 100.0}});
    EXPECT_NEAR(areaOf(readOne()), areaOf(surface::SubdivisionSurface(test::cubeCage())), 1e-9);
    fixture_ = {};
    addCage(test::cubeCage(), {{"fluxwalk_subdivision", "catmullClark"}, {"fluxwalk_crease_angle", "sharp"}});
    EXPECT_EQ(readOne().kind(), "subdivision surface");
    EXPECT_TRUE(test::hasWarning(scene_, "fluxwalk_crease_angle is no angle from 0 to 180 degrees"));
}

TEST_F(GltfCage, TextureCoordinatesStayWithTheirCorners) {
    const int texture = fixture_.addTexture(test::bytesOf("no picture"));
    fixture_.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    json primitive = primitiveOf(exportCage(test::cubeCage()));
    primitive["material"] = 0;
    fixture_.addNode({{"mesh", fixture_.addMesh(primitive)}, {"extras", kCatmullClark}});
    const surface::Surface& cube = readOne();
    // Every face has the whole picture.
    for (std::uint32_t patch = 0; patch < 6; ++patch) {
        double area = 0.0;
        const surface::Region whole = surface::wholePatch(surface::PatchDomain::quad);
        for (std::size_t k = 0; k < 4; ++k) {
            const base::Vec2d a = cube.texcoord(patch, whole.corners[k], 0);
            const base::Vec2d b = cube.texcoord(patch, whole.corners[(k + 1) % 4], 0);
            area += .5 * (a.x * b.y - a.y * b.x);
        }
        EXPECT_NEAR(area, 1.0, 1e-12);
    }
}

TEST_F(GltfCage, PrimitivesMakeOneCage) {
    surface::ControlCage half = test::cubeCage();
    surface::ControlCage rest = half;
    half.faceSizes.resize(3);
    half.corners.resize(12);
    rest.faceSizes.resize(3);
    rest.corners.erase(rest.corners.begin(), rest.corners.begin() + 12);
    const json mesh = {{"primitives", {primitiveOf(exportCage(half)), primitiveOf(exportCage(rest))}}};
    fixture_.addNode({{"mesh", fixture_.add("meshes", mesh)}, {"extras", kCatmullClark}});
    EXPECT_NEAR(areaOf(readOne()), areaOf(surface::SubdivisionSurface(test::cubeCage())), 1e-9);
    EXPECT_TRUE(test::hasWarning(scene_, "an exact surface has one material"));
}

TEST_F(GltfCage, WhatIsNoCageStaysAMeshAndIsNamed) {
    surface::ControlCage fins = test::cubeCage();
    fins.positions.emplace_back(3, -1, -3);
    fins.positions.emplace_back(3, 1, -3);
    test::addFace(fins, {1, 3, 9, 8});
    addCage(fins, kCatmullClark);
    EXPECT_EQ(readOne().kind(), "polygon mesh");
    EXPECT_TRUE(test::hasWarning(scene_, "/nodes/0 'cage': no control cage: the edge between vertices"));
    fixture_ = {};
    addCage(test::cubeCage(), {{"fluxwalk_subdivision", "doo-sabin"}});
    EXPECT_EQ(readOne().kind(), "polygon mesh");
    EXPECT_TRUE(test::hasWarning(scene_, "fluxwalk_subdivision 'doo-sabin' is not known"));
    fixture_ = {};
    addCage(test::cubeCage(), {{"fluxwalk_subdivision", 2}});
    EXPECT_EQ(readOne().kind(), "polygon mesh");
    fixture_ = {};
    addCage(test::cubeCage(), {{"fluxwalk_subdivision", "loop"}, {"fluxwalk_surface", "sphere"}});
    EXPECT_EQ(readOne().kind(), "sphere");
    EXPECT_TRUE(test::hasWarning(scene_, "both fluxwalk_surface and fluxwalk_subdivision"));
}

TEST_F(GltfCage, SingularTransforms) {
    addCage(test::cubeCage(), kCatmullClark, false, {{"scale", {1, 0, 1}}});
    scene_ = read();
    EXPECT_TRUE(test::hasWarning(scene_, "transform leaves a control cage no volume"));
}

}  // namespace
}  // namespace fluxwalk
