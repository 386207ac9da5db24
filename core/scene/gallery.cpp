#include "core/scene/gallery.h"

#include "core/scene/builders.h"

namespace fluxwalk::scene {

Scene buildGallery() {
    Scene scene;
    scene.name = "gallery";
    gallery::addHall(scene);
    gallery::addFurniture(scene);
    gallery::addExhibits(scene);
    gallery::addLights(scene);
    addCamera(scene, "entrance", {0.5, 1.65, 3.9}, {9.0, 1.85, 4.75}, 62.0);
    addCamera(scene, "columns", {0.9, 1.6, 1.0}, {9.5, 1.75, 2.6}, 60.0);
    addCamera(scene, "vases", {4.0, 1.5, 3.7}, {5.35, 1.25, 5.95}, 52.0);
    addCamera(scene, "torus", {8.2, 1.45, 5.7}, {11.3, 1.3, 4.4}, 58.0);
    return scene;
}

}  // namespace fluxwalk::scene
