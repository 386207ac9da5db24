#include "core/scene/gallery.h"

#include "core/scene/builders.h"
#include "core/scene/polygons.h"

namespace fluxwalk::scene {

Scene buildGallery() {
    Scene scene;
    scene.name = "gallery";
    gallery::addHall(scene);
    gallery::addExhibits(scene);
    gallery::addLights(scene);
    addCamera(scene, "entrance", {0.55, 1.65, 4.05}, {9.0, 1.75, 4.75}, 62.0);
    addCamera(scene, "columns", {1.1, 1.6, 0.75}, {9.5, 1.75, 2.9}, 58.0);
    addCamera(scene, "vases", {3.3, 1.55, 3.5}, {5.3, 1.3, 5.9}, 50.0);
    addCamera(scene, "torus", {8.3, 1.45, 5.6}, {11.1, 1.15, 4.45}, 55.0);
    return scene;
}

}  // namespace fluxwalk::scene
