#include "core/io/scene_gltf.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "core/io/file.h"
#include "core/io/gltf_read.h"
#include "core/scene/builders.h"
#include "core/scene/describe.h"
#include "core/scene/polygons.h"
#include "core/scene/shapes.h"
#include "core/surface/cone.h"
#include "core/surface/disk.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"
#include "tests/io/gltf_fixture.h"

namespace fluxwalk {
namespace {

using base::Vec3d;

double areaOf(const surface::Surface& surface) {
    double area = 0.0;
    for (std::uint32_t p = 0; p < surface.patchCount(); ++p) {
        area += surface.area(p, surface::wholePatch(surface.domain(p)));
    }
    return area;
}

void expectSamePoints(const surface::Surface& a, const surface::Surface& b, const std::string& name) {
    ASSERT_EQ(a.patchCount(), b.patchCount()) << name;
    for (std::uint32_t patch = 0; patch < a.patchCount(); ++patch) {
        for (base::Vec2d uv : {base::Vec2d(0.0, 0.0), base::Vec2d(0.31, 0.17), base::Vec2d(0.5, 0.5)}) {
            // A polygon may begin at another corner; its middle stays.
            if (a.kind() == "polygon mesh" && a.domain(patch) == surface::PatchDomain::quad) {
                uv = base::Vec2d(0.5);
            }
            const surface::SurfacePoint p = a.evaluate(patch, uv);
            const surface::SurfacePoint q = b.evaluate(patch, uv);
            EXPECT_LT(glm::distance(p.position, q.position), 1e-6) << name;
            EXPECT_LT(glm::distance(p.normal, q.normal), 1e-6) << name;
        }
    }
}

scene::Scene readBack(const scene::Scene& scene, const test::TemporaryFolder& folder) {
    const std::filesystem::path file = folder.path() / "scene.glb";
    io::writeFile(file, io::packSceneGltf(scene));
    return io::readGltf(file);
}

TEST(SceneGltf, GalleryComesBack) {
    const test::TemporaryFolder folder;
    const scene::Scene built = scene::buildGallery();
    const scene::Scene read = readBack(built, folder);
    EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
    ASSERT_EQ(read.objects.size(), built.objects.size());
    for (std::size_t i = 0; i < built.objects.size(); ++i) {
        const surface::Surface& a = *built.objects[i].surface;
        const surface::Surface& b = *read.objects[i].surface;
        EXPECT_EQ(a.kind(), b.kind()) << built.objects[i].name;
        EXPECT_NEAR(areaOf(b), areaOf(a), 1e-6 * areaOf(a)) << built.objects[i].name;
        expectSamePoints(a, b, built.objects[i].name);
        EXPECT_EQ(built.materials[built.objects[i].material].name,
                  read.materials[read.objects[i].material].name);
    }
    const double lumens = scene::describeScene(built, scene::TextureSet(built)).lumens;
    EXPECT_NEAR(scene::describeScene(read, scene::TextureSet(read)).lumens, lumens, 1e-4 * lumens);
    ASSERT_EQ(read.cameras.size(), built.cameras.size());
    for (std::size_t i = 0; i < built.cameras.size(); ++i) {
        EXPECT_EQ(read.cameras[i].name, built.cameras[i].name);
        EXPECT_LT(glm::distance(read.cameras[i].position, built.cameras[i].position), 1e-12);
        EXPECT_LT(glm::distance(read.cameras[i].forward, built.cameras[i].forward), 1e-12);
    }
    ASSERT_EQ(read.images.size(), built.images.size());
    for (std::size_t i = 0; i < built.images.size(); ++i) {
        EXPECT_EQ(read.images[i].rgba, built.images[i].rgba) << built.images[i].name;
    }
}

// make_gallery (assets/CMakeLists.txt) writes it anew.
TEST(SceneGltf, AssetIsWhatTheBuilderGives) {
    const std::filesystem::path file = std::filesystem::path(FLUXWALK_SOURCE_DIR) / "assets/gallery.glb";
    const std::vector<std::uint8_t> bytes = io::readFile(file);
    EXPECT_LT(bytes.size(), std::size_t{2} << 20);
    EXPECT_TRUE(bytes == io::packSceneGltf(scene::buildGallery()));
}

// Under turns, uneven scales, shears and mirrors, inside out: the same shape in the same place.
TEST(SceneGltf, StretchedShapesComeBack) {
    const test::TemporaryFolder folder;
    scene::Scene built;
    scene::addMaterial(built, "glow", base::Rgb(0.5f), base::Rgb(10.0f));
    const base::Mat4d turned = glm::rotate(glm::translate(base::Mat4d(1.0), Vec3d(1.0, -2.0, 0.5)), 0.7,
                                           glm::normalize(Vec3d(1.0, 2.0, -0.3)));
    base::Mat4d sheared = glm::scale(turned, Vec3d(0.4, 1.7, -2.2));
    sheared[1] += 0.3 * sheared[0];
    for (const base::Mat4d& map : {turned, glm::scale(turned, Vec3d(0.3)), sheared}) {
        for (const bool inside : {false, true}) {
            const auto add = [&](auto surface) { scene::addSurface(built, "shape", 0, std::move(surface)); };
            add(std::make_shared<surface::Sphere>(map, inside));
            add(std::make_shared<surface::Torus>(map, 1.2, 0.35, inside));
            add(std::make_shared<surface::Cone>(map, 0.0, 0.8, 1.3, inside));
            add(std::make_shared<surface::Disk>(map, 0.9, 0.25, inside));
        }
    }
    const scene::Scene read = readBack(built, folder);
    ASSERT_EQ(read.objects.size(), built.objects.size());
    for (std::size_t i = 0; i < built.objects.size(); ++i) {
        EXPECT_EQ(read.objects[i].surface->kind(), built.objects[i].surface->kind());
        expectSamePoints(*built.objects[i].surface, *read.objects[i].surface, std::to_string(i));
    }
}

// Other viewers show the stand-in: it lies on the surface, and faces where that does.
TEST(SceneGltf, StandInsLieOnTheSurface) {
    const test::TemporaryFolder folder;
    scene::Scene built;
    scene::addMaterial(built, "plain", base::Rgb(0.5f), base::Rgb(1.0f));
    scene::addTorus(built, "torus", 0, {3.0, 1.0, -2.0}, 0.8, 0.3);
    scene::addSphere(built, "sphere", 0, {-1.0, 0.5, 2.0}, 0.5);
    io::writeFile(folder.path() / "scene.glb", io::packSceneGltf(built));
    // Without the extras it is a mesh.
    std::vector<std::uint8_t> bytes = io::readFile(folder.path() / "scene.glb");
    const std::string key = "fluxwalk_surface";
    for (auto at = bytes.begin();
         (at = std::search(at, bytes.end(), key.begin(), key.end())) != bytes.end();) {
        *at = 'x';
    }
    io::writeFile(folder.path() / "mesh.glb", bytes);
    const scene::Scene mesh = io::readGltf(folder.path() / "mesh.glb");
    ASSERT_EQ(mesh.objects.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const surface::Surface& standIn = *mesh.objects[i].surface;
        const surface::Surface& exact = *built.objects[i].surface;
        EXPECT_EQ(standIn.kind(), "polygon mesh");
        // Inscribed with 24 (sphere) and 24 x 24 (torus) edges around.
        EXPECT_LT(areaOf(standIn), areaOf(exact));
        EXPECT_GT(areaOf(standIn), 0.97 * areaOf(exact));
        for (std::uint32_t p = 0; p < standIn.patchCount(); ++p) {
            const surface::SurfacePoint at = standIn.evaluate(p, {0.0, 0.0});
            const Vec3d out = i == 1 ? Vec3d(-1.0, 0.5, 2.0) : [&] {
                const Vec3d flat(at.position.x - 3.0, 0.0, at.position.z + 2.0);
                return Vec3d(3.0, 1.0, -2.0) + 0.8 * glm::normalize(flat);
            }();
            EXPECT_NEAR(glm::distance(at.position, out), i == 1 ? 0.5 : 0.3, 1e-6);
            EXPECT_GT(glm::dot(at.normal, at.position - out), 0.0);
        }
    }
}

}  // namespace
}  // namespace fluxwalk
