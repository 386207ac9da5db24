#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/surface/sphere.h"

namespace fluxwalk::scene {

namespace {

/// Published in millimetres.
Vec3d mm(double x, double y, double z) {
    return Vec3d(x, y, z) * 1e-3;
}

constexpr double kHeight = 548.8;
constexpr double kDepth = 559.2;

Quads floorQuad() {
    return {{mm(552.8, 0, 0), mm(0, 0, 0), mm(0, 0, kDepth), mm(549.6, 0, kDepth)}};
}

Quads backWall() {
    return {{mm(549.6, 0, kDepth), mm(0, 0, kDepth), mm(0, kHeight, kDepth), mm(556, kHeight, kDepth)}};
}

Quads rightWall() {
    return {{mm(0, 0, kDepth), mm(0, 0, 0), mm(0, kHeight, 0), mm(0, kHeight, kDepth)}};
}

// Slightly twisted: two triangles, as ALGORITHMS 3.10 fixes it.
Quads leftWall() {
    return {{mm(552.8, 0, 0), mm(549.6, 0, kDepth), mm(556, kHeight, kDepth), mm(556, kHeight, 0)}};
}

Quad ceilingPart(double x0, double x1, double z0, double z1) {
    return {mm(x1, kHeight, z0), mm(x1, kHeight, z1), mm(x0, kHeight, z1), mm(x0, kHeight, z0)};
}

Quad lampQuad() {
    return ceilingPart(213, 343, 227, 332);
}

// Eight rectangles around the lamp, so that no area is covered twice.
Quads ceilingAroundLamp() {
    constexpr std::array<double, 4> kX{0, 213, 343, 556};
    constexpr std::array<double, 4> kZ{0, 227, 332, kDepth};
    Quads parts;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (i != 1 || j != 1) {
                parts.push_back(ceilingPart(kX[i], kX[i + 1], kZ[j], kZ[j + 1]));
            }
        }
    }
    return parts;
}

// Top and four sides down to the floor; `top` counter-clockwise seen from above.
Quads block(const Quad& top) {
    Quads faces{top};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d& a = top[i];
        const Vec3d& b = top[(i + 1) % 4];
        faces.push_back({Vec3d(a.x, 0, a.z), Vec3d(b.x, 0, b.z), b, a});
    }
    return faces;
}

Quads shortBlock() {
    return block({mm(130, 165, 65), mm(82, 165, 225), mm(240, 165, 272), mm(290, 165, 114)});
}

Quads tallBlock() {
    return block({mm(423, 330, 247), mm(265, 330, 296), mm(314, 330, 456), mm(472, 330, 406)});
}

// Published with a focal length of 35 mm and a film of 25 mm.
void addPublishedCamera(Scene& scene) {
    addCamera(scene, "front", mm(278, 273, -800), mm(278, 273, 0), 39.3076480);
}

}  // namespace

Scene buildCornellBox(const Rgb& lampExitance) {
    Scene scene;
    scene.name = "cornell-box";
    const std::uint32_t white = addMaterial(scene, "white", {0.725f, 0.71f, 0.68f});
    const std::uint32_t green = addMaterial(scene, "green", {0.14f, 0.45f, 0.091f});
    const std::uint32_t red = addMaterial(scene, "red", {0.63f, 0.065f, 0.05f});
    const std::uint32_t lamp = addMaterial(scene, "lamp", Rgb(0.78f), lampExitance);
    addPolygons(scene, "floor", white, floorQuad());
    addPolygons(scene, "ceiling", white, ceilingAroundLamp());
    addPolygons(scene, "back wall", white, backWall());
    addPolygons(scene, "right wall", green, rightWall());
    addPolygons(scene, "left wall", red, leftWall());
    addPolygons(scene, "short block", white, shortBlock());
    addPolygons(scene, "tall block", white, tallBlock());
    addPolygons(scene, "lamp", lamp, {lampQuad()});
    addPublishedCamera(scene);
    return scene;
}

Scene buildFurnace(float reflectance, bool withSphere) {
    Scene scene;
    scene.name = withSphere ? "furnace" : "furnace-planar";
    const std::uint32_t walls = addMaterial(scene, "glowing", Rgb(reflectance), Rgb(1.0f));
    const std::uint32_t blocks = addMaterial(scene, "glowing on both sides", Rgb(reflectance), Rgb(1.0f));
    scene.materials[blocks].doubleSided = true;
    addPolygons(scene, "floor", walls, floorQuad());
    addPolygons(scene, "ceiling", walls, {ceilingPart(0, 556, 0, kDepth)});
    addPolygons(scene, "back wall", walls, backWall());
    addPolygons(scene, "right wall", walls, rightWall());
    addPolygons(scene, "left wall", walls, leftWall());
    addPolygons(scene, "front wall", walls,
                {{mm(0, 0, 0), mm(552.8, 0, 0), mm(556, kHeight, 0), mm(0, kHeight, 0)}});
    addPolygons(scene, "short block", blocks, shortBlock());
    addPolygons(scene, "tall block", blocks, tallBlock());
    if (withSphere) {
        scene.objects.push_back({"sphere", std::make_shared<surface::Sphere>(mm(150, 120, 440), 0.1), walls});
    }
    addCamera(scene, "inside", mm(278, 400, 20), mm(278, 150, 400), 75.0);
    return scene;
}

}  // namespace fluxwalk::scene
