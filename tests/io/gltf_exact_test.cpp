// Exact surfaces in node extras: sizes, defaults from the stand-in, and what is wrong with them.
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/photometry.h"
#include "core/surface/region.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using base::kPi;
using base::Vec3d;
using test::GltfFixture;
using test::json;

// A file of exact surfaces.
class ExactFile {
  public:
    ExactFile() { fixture.add("materials", {{"name", "grey"}}); }

    // A stand-in whose bounds are +-half about `center`.
    int addStandIn(const Vec3d& half, const Vec3d& center = Vec3d(0.0)) {
        std::vector<float> xyz;
        for (const Vec3d& corner : {Vec3d(-1, -1, -1), Vec3d(1, 1, -1), Vec3d(1, -1, 1)}) {
            for (int i = 0; i < 3; ++i) {
                xyz.push_back(static_cast<float>(center[i] + half[i] * corner[i]));
            }
        }
        return fixture.addMesh({{"attributes", {{"POSITION", fixture.addPositions(xyz)}}}, {"material", 0}});
    }

    // Adds a node with an exact surface; `more` is merged into its extras.
    void addExact(const std::string& kind, int mesh, const json& more = json::object(),
                  const json& nodeMore = json::object()) {
        json extras = {{"fluxwalk_surface", kind}};
        extras.update(more);
        json node = {{"mesh", mesh}, {"name", "it"}, {"extras", extras}};
        node.update(nodeMore);
        fixture.addNode(node);
    }

    // A scene without any surface is refused.
    void addFloor() { fixture.addNode({{"mesh", fixture.addSquare()}}); }

    scene::Scene read() { return fixture.read(folder); }

    GltfFixture fixture;
    test::TemporaryFolder folder;
};

double areaOf(const scene::Object& object) {
    double area = 0.0;
    for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
        area += object.surface->area(p, surface::wholePatch(object.surface->domain(p)));
    }
    return area;
}

// Reads a scene of one surface over a stand-in of half size (2, 1, 2), and returns its area.
double areaWith(const std::string& kind, const json& extras) {
    ExactFile file;
    file.addExact(kind, file.addStandIn({2, 1, 2}), extras);
    const scene::Scene scene = file.read();
    EXPECT_EQ(scene.objects.size(), 1u) << kind << extras;
    EXPECT_FALSE(test::hasWarning(scene, "'it'")) << kind << extras;
    return scene.objects.empty() ? 0.0 : areaOf(scene.objects[0]);
}

// Reads the same, and expects a warning that names the node, and that the object is there or not.
void expectWarning(const std::string& kind, const json& extras, const std::string& warning, bool isRead,
                   const json& nodeMore = json::object()) {
    ExactFile file;
    file.addExact(kind, file.addStandIn({2, 1, 2}), extras, nodeMore);
    file.addFloor();
    const scene::Scene scene = file.read();
    EXPECT_EQ(scene.objects.size(), isRead ? 2u : 1u) << kind << extras << nodeMore;
    EXPECT_TRUE(test::hasWarning(scene, warning)) << kind << extras << nodeMore;
    EXPECT_TRUE(test::hasWarning(scene, "/nodes/0 'it'")) << kind << extras << nodeMore;
    if (isRead && !scene.objects.empty()) {
        EXPECT_EQ(scene.objects[0].surface->kind(), kind);
        EXPECT_GT(areaOf(scene.objects[0]), 0.0);
    }
}

double frustumArea(double bottom, double top, double height) {
    return kPi * (bottom + top) * std::hypot(bottom - top, height);
}

TEST(GltfExact, SizesAreReadOrTakenFromTheStandIn) {
    EXPECT_NEAR(areaWith("cylinder", json::object()), 2 * kPi * 2 * 2, 1e-12);
    EXPECT_NEAR(areaWith("cylinder", {{"fluxwalk_radius", .5}}), 2 * kPi * .5 * 2, 1e-12);
    EXPECT_NEAR(areaWith("cylinder", {{"fluxwalk_radius", .5}, {"fluxwalk_height", 3}}), 3 * kPi, 1e-12);
    EXPECT_NEAR(areaWith("cone", json::object()), frustumArea(2, 0, 2), 1e-12);
    EXPECT_NEAR(areaWith("cone", {{"fluxwalk_radius_top", .5}}), frustumArea(2, .5, 2), 1e-12);
    EXPECT_NEAR(areaWith("cone", {{"fluxwalk_radius_top", 2}}), frustumArea(0, 2, 2), 1e-12);
    EXPECT_NEAR(areaWith("cone", {{"fluxwalk_radius_bottom", .5}}), frustumArea(.5, 2, 2), 1e-12);
    EXPECT_NEAR(areaWith("cone", {{"fluxwalk_radius_bottom", 0}}), frustumArea(0, 2, 2), 1e-12);
    EXPECT_NEAR(
        areaWith("cone", {{"fluxwalk_radius_bottom", 3}, {"fluxwalk_radius_top", 1}, {"fluxwalk_height", 5}}),
        frustumArea(3, 1, 5), 1e-12);
    EXPECT_NEAR(areaWith("disk", json::object()), 4 * kPi, 1e-12);
    EXPECT_NEAR(areaWith("disk", {{"fluxwalk_radius", 3}, {"fluxwalk_inner_radius", 1}}), 8 * kPi, 1e-12);
    EXPECT_NEAR(areaWith("torus", json::object()), 4 * kPi * kPi * 1 * 1, 1e-12);
    EXPECT_NEAR(areaWith("torus", {{"fluxwalk_minor_radius", .5}}), 4 * kPi * kPi * 1.5 * .5, 1e-12);
    EXPECT_NEAR(areaWith("torus", {{"fluxwalk_major_radius", 3}}), 4 * kPi * kPi * 3 * 1, 1e-12);
    EXPECT_NEAR(areaWith("torus", {{"fluxwalk_major_radius", 3}, {"fluxwalk_minor_radius", .1}}),
                4 * kPi * kPi * .3, 1e-12);
}

TEST(GltfExact, TransformAndSideApply) {
    ExactFile file;
    const int mesh = file.addStandIn({1, 1, 1});
    const json place = {{"translation", {1, 2, 3}}, {"scale", {2, 4, -2}}};
    for (const char* kind : {"cylinder", "cone", "disk", "torus"}) {
        const json minor = {{"fluxwalk_major_radius", 1}, {"fluxwalk_minor_radius", .25}};
        file.addExact(kind, mesh, minor, place);
        json within = minor;
        within["fluxwalk_inside"] = true;
        file.addExact(kind, mesh, within, place);
    }
    const scene::Scene scene = file.read();
    ASSERT_EQ(scene.objects.size(), 8u);
    EXPECT_NEAR(areaOf(scene.objects[0]), 2 * kPi * 2 * 8, 1e-12);
    EXPECT_NEAR(areaOf(scene.objects[2]), frustumArea(2, 0, 8), 1e-12);
    EXPECT_NEAR(areaOf(scene.objects[4]), 4 * kPi, 1e-12);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const surface::Surface& shape = *scene.objects[i].surface;
        EXPECT_LT(glm::distance(shape.bounds().center(), Vec3d(1, 2, 3)), 1e-12) << i;
        // Outermost first patch: outwards, or upwards for the disk.
        const surface::SurfacePoint p = shape.evaluate(0, {.5, .2});
        const Vec3d outwards = i / 2 == 2 ? Vec3d(0, 1, 0) : p.position - Vec3d(1, 2, 3);
        EXPECT_GT((i % 2 == 0 ? 1.0 : -1.0) * glm::dot(p.normal, outwards), 0.0) << i;
    }
}

TEST(GltfExact, BadSizesAreNamed) {
    const std::string positive = " is not a positive number; the stand-in's size is used";
    const std::string zero = " is not a number of at least 0; the stand-in's size is used";
    for (const json& bad : {json(0), json(-1), json("1"), json::array({1}), json(true)}) {
        const bool isZero = bad.is_number() && bad == 0;
        for (const char* kind : {"sphere", "cylinder", "disk"}) {
            expectWarning(kind, {{"fluxwalk_radius", bad}}, "fluxwalk_radius" + positive, true);
        }
        for (const char* kind : {"cylinder", "cone"}) {
            expectWarning(kind, {{"fluxwalk_height", bad}}, "fluxwalk_height" + positive, true);
        }
        for (const std::string key : {"fluxwalk_major_radius", "fluxwalk_minor_radius"}) {
            expectWarning("torus", {{key, bad}}, key + positive, true);
        }
        if (!isZero) {
            for (const std::string key : {"fluxwalk_radius_bottom", "fluxwalk_radius_top"}) {
                expectWarning("cone", {{key, bad}}, key + zero, true);
            }
            expectWarning(
                "disk", {{"fluxwalk_inner_radius", bad}},
                "fluxwalk_inner_radius is not a number of at least 0 and below the radius; left out", false);
        }
    }
    for (const json& bad : {json("yes"), json::array({1})}) {
        expectWarning("torus", {{"fluxwalk_inside", bad}}, "fluxwalk_inside is neither true nor false", true);
    }
}

TEST(GltfExact, SizesThatFitNoSurfaceAreNamed) {
    expectWarning("torus", {{"fluxwalk_major_radius", 1}, {"fluxwalk_minor_radius", 1.01}},
                  "the torus' tube radius is above its ring's; left out", false);
    expectWarning("torus", {{"fluxwalk_minor_radius", 1e-12}}, "the torus's size or transform", false);
    expectWarning("torus", {{"fluxwalk_minor_radius", 3}}, "tube radius is above", false);
    expectWarning("disk", {{"fluxwalk_inner_radius", 2}}, "fluxwalk_inner_radius is not", false);
    expectWarning("cone", {{"fluxwalk_radius_bottom", 0}, {"fluxwalk_radius_top", 0}},
                  "the cone's size or transform leaves it no area; left out", false);
    for (const char* kind : {"sphere", "cylinder", "cone", "disk", "torus"}) {
        const std::string noArea =
            "the " + std::string(kind) + "'s size or transform leaves it no area; left out";
        expectWarning(kind, json::object(), noArea, false, {{"scale", {1, 0, 1}}});
        expectWarning(kind, json::object(), noArea, false, {{"scale", {1e10, 1e10, 1e10}}});
        expectWarning(kind, json::object(), noArea, false,
                      {{"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}}});
        expectWarning(
            kind,
            {{"fluxwalk_radius", 1e300}, {"fluxwalk_radius_bottom", 1e300}, {"fluxwalk_major_radius", 1e300}},
            noArea, false);
    }
    ExactFile file;
    // A flat stand-in knows no height.
    file.addExact("cylinder", file.addStandIn({1, 0, 1}));
    file.addExact("torus", file.addStandIn({1, 0, 1}));
    file.addFloor();
    EXPECT_EQ(file.read().objects.size(), 1u);
}

// Numbers that JSON cannot hold are an error of the file.
TEST(GltfExact, InfiniteSizesAreRefused) {
    ExactFile exact;
    exact.addExact("cylinder", exact.addStandIn({1, 1, 1}), {{"fluxwalk_radius", 12345.5}});
    json root = exact.fixture.root;
    root["buffers"] = {{{"byteLength", exact.fixture.bin.size()}}};
    const auto file = exact.folder.path() / "scene.glb";
    for (const std::string number : {"1e999", "-1e999", "NaN", "Infinity"}) {
        std::string text = root.dump();
        text.replace(text.find("12345.5"), 7, number);
        test::writeBytes(file, GltfFixture::packGlb(text, exact.fixture.bin));
        EXPECT_NE(test::errorOf(file), "no error") << number;
    }
}

TEST(GltfExact, StandInsOffTheirNodeAreNamed) {
    for (const char* kind : {"cylinder", "cone", "disk", "torus"}) {
        ExactFile file;
        file.addExact(kind, file.addStandIn({2, .5, 2}, {0, .4, 0}));
        const scene::Scene scene = file.read();
        EXPECT_EQ(scene.objects.size(), 1u);
        EXPECT_TRUE(test::hasWarning(
            scene, "the stand-in mesh is not centred on its node; the " + std::string(kind) + " is"));
    }
}

}  // namespace
}  // namespace fluxwalk
