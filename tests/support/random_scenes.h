#pragma once

#include <cmath>
#include <memory>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/scene/polygons.h"
#include "core/surface/polygon_mesh.h"
#include "core/surface/sphere.h"

/// Random geometry under a key.
namespace fluxwalk::test {

using base::Vec3d;

inline Vec3d randomDirection(base::RandomStream& random) {
    const double y = 1.0 - 2.0 * random.next();
    const double angle = 2.0 * base::kPi * random.next();
    const double flat = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {flat * std::cos(angle), y, flat * std::sin(angle)};
}

/// A point of the cube [-size, size]^3.
inline Vec3d randomPoint(base::RandomStream& random, double size) {
    const double x = random.next();
    const double y = random.next();
    return size * (2.0 * Vec3d(x, y, random.next()) - 1.0);
}

/// A parallelogram about a random point, its edges up to `size` long.
inline scene::Quad randomQuad(base::RandomStream& random, double spread, double size) {
    const Vec3d at = randomPoint(random, spread);
    const Vec3d e1 = size * (0.2 + 0.8 * random.next()) * randomDirection(random);
    const Vec3d across = glm::normalize(glm::cross(e1, randomDirection(random)));
    const Vec3d e2 = size * (0.2 + 0.8 * random.next()) * across + 0.3 * random.next() * e1;
    return {at, at + e1, at + e1 + e2, at + e2};
}

/// Objects of random quads and of spheres (half of them ellipsoids) in [-1, 1]^3, all of one grey material
/// that emits.
inline scene::Scene randomScene(std::uint64_t key, unsigned meshes, unsigned quadsPerMesh, unsigned spheres,
                                double size = 0.7) {
    base::RandomStream random(key);
    scene::Scene scene;
    const std::uint32_t grey = scene::addMaterial(scene, "grey", base::Rgb(0.5f), base::Rgb(1.0f));
    scene.materials[grey].doubleSided = true;
    for (unsigned m = 0; m < meshes; ++m) {
        scene::Quads quads;
        for (unsigned q = 0; q < quadsPerMesh; ++q) {
            quads.push_back(randomQuad(random, 1.0, size));
        }
        scene::addPolygons(scene, "quads", grey, quads);
    }
    for (unsigned s = 0; s < spheres; ++s) {
        const Vec3d center = randomPoint(random, 1.0);
        const double radius = size * (0.1 + 0.3 * random.next());
        if (s % 2 == 0) {
            scene.objects.push_back(
                {"sphere", std::make_shared<surface::Sphere>(center, radius, s % 4 == 2), grey});
        } else {
            base::Mat4d place(1.0);
            const Vec3d a = randomDirection(random);
            const Vec3d b = glm::normalize(glm::cross(a, randomDirection(random)));
            place[0] = {radius * a, 0.0};
            place[1] = {1.7 * radius * b, 0.0};
            place[2] = {0.6 * radius * glm::cross(a, b), 0.0};
            place[3] = {center, 1.0};
            scene.objects.push_back({"ellipsoid", std::make_shared<surface::Sphere>(place), grey});
        }
    }
    return scene;
}

}  // namespace fluxwalk::test
