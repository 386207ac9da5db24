#include "core/base/check.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/surface/dual_cage.h"

namespace fluxwalk::scene {

Scene buildBlobs() {
    Scene scene;
    scene.name = "blobs";
    const std::uint32_t walls = addMaterial(scene, "plaster", {0.75f, 0.72f, 0.66f});
    // 4,000 lm from a panel of 1.2 m x 1.2 m.
    const Rgb exitance = Rgb(1.04f, 1.0f, 0.88f) * (4000.0f / 1.44f);
    const std::uint32_t lamp = addMaterial(scene, "lamp", Rgb(0.6f), exitance);
    const std::uint32_t stone = addMaterial(scene, "stone", Rgb(0.4f));
    const std::uint32_t glaze = addMaterial(scene, "glaze", {0.62f, 0.24f, 0.16f});
    addPolygons(scene, "room", walls, boxFaces(Vec3d(0.0), {4.0, 3.0, 4.0}, kAllFaces, true));
    addPolygons(scene, "lamp", lamp, boxFaces({1.4, 2.95, 1.4}, {2.6, 2.95, 2.6}, kBottom));
    addPolygons(scene, "plinth", stone, boxFaces({1.45, 0.0, 1.45}, {2.55, 0.5, 2.55}, kStanding));
    // Sunk into the plinth by 2 cm.
    const auto sculpture =
        std::make_shared<const surface::SmoothUnion>(std::vector<surface::Ball>{{{2.0, 0.88, 2.0}, 0.40},
                                                                                {{2.25, 1.42, 2.15}, 0.27},
                                                                                {{1.66, 1.38, 1.88}, 0.24},
                                                                                {{2.02, 1.84, 2.0}, 0.22}});
    auto cage = surface::buildDualCage(sculpture);
    FLUXWALK_CHECK(cage.has_value());
    scene.objects.push_back(
        {"sculpture", std::make_shared<surface::ProjectedSurface>(sculpture, std::move(*cage)), glaze});
    addCamera(scene, "corner", {0.45, 1.55, 0.35}, {2.0, 1.1, 2.0}, 50.0);
    return scene;
}

}  // namespace fluxwalk::scene
