#include "core/hierarchy/cavities.h"

#include <gtest/gtest.h>

#include "core/scene/polygons.h"
#include "core/surface/region.h"

namespace fluxwalk {
namespace {

using base::Executor;
using base::Rgb;
using base::Vec3d;
using hierarchy::ReachedSides;
using scene::boxFaces;
using scene::Scene;

/// A lit room and in it, object 2, a cupboard of six boards in one mesh, whose door leaves `gap` open at the
/// front.
Scene buildRoomWithCupboard(double gap) {
    Scene scene;
    addMaterial(scene, "grey", Rgb(0.5f));
    addMaterial(scene, "lamp", Rgb(0.5f), Rgb(1000.0f));
    addPolygons(scene, "room", 0, boxFaces({0, 0, 0}, {4, 3, 4}, scene::kAllFaces, true));
    addPolygons(scene, "lamp", 1, boxFaces({1.5, 2.9, 1.5}, {2.5, 2.9, 2.5}, scene::kBottom));
    const double b = 0.02;
    addPolygons(
        scene, "cupboard", 0,
        scene::join({boxFaces({1, 0.5, 1}, {2, 0.5 + b, 1.5}), boxFaces({1, 1.5, 1}, {2, 1.5 + b, 1.5}),
                     boxFaces({1, 0.5 + b, 1}, {1 + b, 1.5, 1.5}),
                     boxFaces({2 - b, 0.5 + b, 1}, {2, 1.5, 1.5}),
                     boxFaces({1 + b, 0.5 + b, 1}, {2 - b, 1.5, 1 + b}),
                     boxFaces({1 + b + gap, 0.5 + b, 1.5 - b}, {2 - b, 1.5, 1.5})}));
    return scene;
}

/// Patches of the cupboard whose middles lie on its inside and that light reaches.
int countLitInside(const Scene& scene, unsigned threads = 1) {
    const Executor executor(threads);
    const rays::RayScene rays(scene, executor);
    const ReachedSides reached = hierarchy::findReachedSides(scene, rays, executor, 1);
    const surface::Surface& surface = *scene.objects[2].surface;
    int count = 0;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        const Vec3d p = surface.bounds(patch, surface::wholePatch(surface.domain(patch))).box.center();
        const bool isInside =
            p.x > 1.019 && p.x < 1.981 && p.y > 0.519 && p.y < 1.501 && p.z > 1.019 && p.z < 1.481;
        count += isInside && reached.isReached(2, patch, false) ? 1 : 0;
        if (!isInside && (p.y > 1.51 || p.y < 0.51)) {
            EXPECT_TRUE(reached.isReached(2, patch, false)) << "outside " << patch;
        }
    }
    return count;
}

TEST(Cavities, theInsideOfAShutCupboardTakesNoPart) {
    EXPECT_EQ(countLitInside(buildRoomWithCupboard(0.0)), 0);
    EXPECT_EQ(countLitInside(buildRoomWithCupboard(0.0), 4), 0);
}

TEST(Cavities, lightEntersWhereTheDoorIsAjar) {
    EXPECT_EQ(countLitInside(buildRoomWithCupboard(0.02)), 6);
}

TEST(Cavities, aLampWithinLightsIt) {
    Scene scene = buildRoomWithCupboard(0.0);
    scene::Light light;
    light.kind = scene::LightKind::point;
    light.position = {1.5, 1.0, 1.25};
    light.intensity = Rgb(10.0f);
    scene.lights.push_back(light);
    EXPECT_EQ(countLitInside(scene), 6);
}

}  // namespace
}  // namespace fluxwalk
