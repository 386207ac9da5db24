#include "tests/support/hard_scenes.h"

#include "core/scene/polygons.h"
#include "core/surface/polygon_mesh.h"
#include "tests/support/random_scenes.h"

namespace fluxwalk::test {

using base::Rgb;
using scene::addMaterial;
using scene::addPolygons;
using scene::boxFaces;
using scene::Scene;

namespace {

// A closed room from `at`, seen from inside; a lamp of 1 m2 hangs under its ceiling.
std::uint32_t addLitRoom(Scene& scene, const Vec3d& at, const Vec3d& size) {
    const std::uint32_t grey = addMaterial(scene, "grey", Rgb(0.5f));
    const std::uint32_t glow = addMaterial(scene, "glow", Rgb(0.5f), Rgb(1000.0f));
    addPolygons(scene, "room", grey, boxFaces(at, at + size, scene::kAllFaces, true));
    const Vec3d lamp = at + Vec3d(0.5 * size.x - 0.5, size.y - 0.25, 0.5 * size.z - 0.5);
    addPolygons(scene, "lamp", glow, boxFaces(lamp, lamp + Vec3d(1.0, 0.0, 1.0), scene::kBottom));
    addCamera(scene, "corner", at + Vec3d(0.25, 0.5 * size.y, 0.25), at + 0.5 * size, 60.0);
    return grey;
}

}  // namespace

Scene buildOnePolygon() {
    Scene scene;
    scene.name = "one polygon";
    const std::uint32_t glow = addMaterial(scene, "glow", Rgb(0.5f), Rgb(100.0f));
    addPolygons(scene, "square", glow, boxFaces(Vec3d(0.0), {1.0, 0.0, 1.0}, scene::kTop));
    return scene;
}

Scene buildCoincident(unsigned count) {
    Scene scene;
    scene.name = "coincident polygons";
    const std::uint32_t grey = addLitRoom(scene, Vec3d(0.0), {4.0, 3.0, 4.0});
    for (unsigned i = 0; i < count; ++i) {
        addPolygons(scene, "square", grey, boxFaces({1.5, 1.0, 1.5}, {2.5, 1.0, 2.5}, scene::kTop));
    }
    return scene;
}

Scene buildHugePolygon() {
    constexpr double kHalf = 1e6;
    Scene scene;
    scene.name = "huge polygon";
    const std::uint32_t grey = addLitRoom(scene, {-kHalf, 0.0, -kHalf}, {2.0 * kHalf, 3.0, 2.0 * kHalf});
    addPolygons(scene, "table", grey, boxFaces({-1.0, 0.0, -1.0}, {1.0, 0.75, 1.0}, scene::kStanding));
    return scene;
}

Scene buildFarAway() {
    const Vec3d at(1e6);
    Scene scene;
    scene.name = "far away";
    const std::uint32_t grey = addLitRoom(scene, at, {4.0, 3.0, 4.0});
    addPolygons(scene, "table", grey,
                boxFaces(at + Vec3d(1.0, 0.0, 1.0), at + Vec3d(2.0, 0.75, 3.0), scene::kStanding));
    addPolygons(scene, "stool", grey,
                boxFaces(at + Vec3d(2.5, 0.0, 1.5), at + Vec3d(3.0, 0.5, 2.0), scene::kStanding));
    return scene;
}

Scene buildCloud(unsigned count, std::uint64_t seed) {
    constexpr double kHalf = 5.0;
    constexpr unsigned kPerObject = 50;
    Scene scene;
    scene.name = "cloud";
    const std::uint32_t grey = addMaterial(scene, "grey", Rgb(0.5f));
    const std::uint32_t glow = addMaterial(scene, "glow", Rgb(0.5f), Rgb(50.0f));
    scene.materials[glow].doubleSided = true;
    addPolygons(scene, "room", grey, boxFaces(Vec3d(-kHalf), Vec3d(kHalf), scene::kAllFaces, true));
    addCamera(scene, "corner", Vec3d(-0.9 * kHalf), Vec3d(0.0), 60.0);
    for (unsigned first = 0; first < count; first += kPerObject) {
        base::RandomStream random(base::combine(seed, first));
        surface::TriangleSoup soup;
        for (unsigned i = first; i < std::min(count, first + kPerObject); ++i) {
            // An edge, and a second one across it of at least a third of its length.
            const Vec3d a = randomPoint(random, kHalf - 0.25);
            const double length = 0.06 + 0.1 * random.next();
            const Vec3d along = randomDirection(random);
            const Vec3d across = glm::normalize(glm::cross(along, randomDirection(random)));
            const Vec3d b = a + length * along;
            const Vec3d c =
                a + length * ((0.2 + 0.6 * random.next()) * along + (0.35 + 0.6 * random.next()) * across);
            const auto at = static_cast<std::uint32_t>(soup.positions.size());
            soup.positions.insert(soup.positions.end(), {base::Vec3(a), base::Vec3(b), base::Vec3(c)});
            soup.triangles.push_back({at, at + 1, at + 2});
        }
        const unsigned number = first / kPerObject;
        scene.objects.push_back({"triangles", std::make_shared<surface::PolygonMesh>(std::move(soup)),
                                 number % 10 == 0 ? glow : grey});
    }
    return scene;
}

}  // namespace fluxwalk::test
