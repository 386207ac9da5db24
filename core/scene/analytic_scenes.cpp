#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"

namespace fluxwalk::scene {

namespace {

// Source and receiver of one reflectance; only the source emits.
Scene buildPair(std::string name, float reflectance, const Quad& source, const Quad& receiver) {
    Scene scene;
    scene.name = std::move(name);
    const std::uint32_t emitting = addMaterial(scene, "emitting", Rgb(reflectance), Rgb(1.0f));
    const std::uint32_t receiving = addMaterial(scene, "receiving", Rgb(reflectance));
    addPolygons(scene, "source", emitting, {source});
    addPolygons(scene, "receiver", receiving, {receiver});
    return scene;
}

}  // namespace

Scene buildParallelSquares(double gap, float reflectance) {
    const Quads both = boxFaces({0, 0, 0}, {1, gap, 1}, kTop | kBottom, true);
    Scene scene = buildPair("squares-parallel", reflectance, both[1], both[0]);
    addCamera(scene, "side", {1.5, 0.6 + 0.25 * gap, -1.0}, {0.55, 0.4 * gap, 0.4}, 50.0);
    return scene;
}

Scene buildWedge(double degrees, float reflectance) {
    const double angle = degrees * base::kPi / 180.0;
    const Vec3d along(std::cos(angle), std::sin(angle), 0.0);
    const Vec3d edge(0, 0, 1);
    const Quad receiver{Vec3d(0, 0, 0), Vec3d(0, 0, 1), Vec3d(1, 0, 1), Vec3d(1, 0, 0)};
    const Quad source{Vec3d(0, 0, 0), along, along + edge, edge};
    Scene scene = buildPair("wedge", reflectance, source, receiver);
    addCamera(scene, "side", {1.7, 0.7, -0.6}, {0.5, 0.2, 0.5}, 45.0);
    return scene;
}

Scene buildCie58(float reflectance) {
    Scene scene;
    scene.name = "cie-5.8";
    const std::uint32_t walls = addMaterial(scene, "walls", Rgb(reflectance));
    addPolygons(scene, "cube", walls, boxFaces(Vec3d(0.0), Vec3d(4.0), kAllFaces, true));
    Light light;
    light.name = "isotropic source";
    light.intensity = Rgb(static_cast<float>(10000.0 / (4.0 * base::kPi)));
    light.position = Vec3d(2.0);
    scene.lights.push_back(light);
    addCamera(scene, "corner", {0.2, 3.4, 0.2}, {2.6, 1.4, 2.6}, 75.0);
    return scene;
}

Scene buildStrips(double length, unsigned segments, float reflectance) {
    Scene scene;
    scene.name = "strips";
    const std::uint32_t glowing = addMaterial(scene, "glowing", Rgb(reflectance), Rgb(1.0f));
    const Quads both = boxFaces({0, 0, 0}, {1, 1, length}, kTop | kBottom, true);
    addPolygons(scene, "lower plate", glowing, gridOf(both[0], 1, segments));
    addPolygons(scene, "upper plate", glowing, gridOf(both[1], 1, segments));
    addCamera(scene, "end", {0.5, 0.6, -0.6}, {0.5, 0.45, 3.0}, 60.0);
    return scene;
}

}  // namespace fluxwalk::scene
