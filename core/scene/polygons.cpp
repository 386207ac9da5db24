#include "core/scene/polygons.h"

#include "core/base/photometry.h"
#include "core/surface/polygon_mesh.h"

namespace fluxwalk::scene {

Quads boxFaces(const Vec3d& lower, const Vec3d& upper, unsigned faces, bool inwards) {
    const auto corner = [&](int x, int y, int z) {
        return Vec3d(x != 0 ? upper.x : lower.x, y != 0 ? upper.y : lower.y, z != 0 ? upper.z : lower.z);
    };
    const std::array<Quad, 6> all{{
        {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)},
        {corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1)},
        {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)},
        {corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0)},
        {corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0)},
        {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)},
    }};
    Quads chosen;
    for (unsigned f = 0; f < 6; ++f) {
        if ((faces & (1u << f)) != 0) {
            const Quad& q = all[f];
            chosen.push_back(inwards ? Quad{q[3], q[2], q[1], q[0]} : q);
        }
    }
    return chosen;
}

Quads gridOf(const Quad& quad, unsigned columns, unsigned rows) {
    const auto at = [&](unsigned i, unsigned j) {
        const double s = static_cast<double>(i) / columns;
        const double t = static_cast<double>(j) / rows;
        return (1 - t) * ((1 - s) * quad[0] + s * quad[1]) + t * ((1 - s) * quad[3] + s * quad[2]);
    };
    Quads cells;
    cells.reserve(static_cast<std::size_t>(columns) * rows);
    for (unsigned j = 0; j < rows; ++j) {
        for (unsigned i = 0; i < columns; ++i) {
            cells.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return cells;
}

Quads join(std::initializer_list<Quads> parts) {
    Quads all;
    for (const Quads& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

void addPolygons(Scene& scene, std::string name, std::uint32_t material, const Quads& quads) {
    addTexturedPolygons(scene, std::move(name), material, quads, {});
}

void addTexturedPolygons(Scene& scene, std::string name, std::uint32_t material, const Quads& quads,
                         const std::function<base::Vec2(const Vec3d& place)>& texcoordAt) {
    surface::TriangleSoup soup;
    for (const Quad& quad : quads) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (const Vec3d& corner : quad) {
            soup.positions.emplace_back(corner);
            if (texcoordAt) {
                soup.texcoords[0].push_back(texcoordAt(corner));
            }
        }
        soup.triangles.push_back({first, first + 1, first + 2});
        soup.triangles.push_back({first, first + 2, first + 3});
    }
    scene.objects.push_back(
        {std::move(name), std::make_shared<surface::PolygonMesh>(std::move(soup)), material});
}

std::uint32_t addMaterial(Scene& scene, std::string name, const Rgb& reflectance, const Rgb& emission) {
    Material material;
    material.name = std::move(name);
    material.reflectance = reflectance;
    material.emission = emission;
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void addCamera(Scene& scene, std::string name, const Vec3d& eye, const Vec3d& target, double fovDegrees) {
    Camera camera;
    camera.name = std::move(name);
    camera.position = eye;
    camera.forward = glm::normalize(target - eye);
    const Vec3d right = glm::normalize(glm::cross(camera.forward, Vec3d(0.0, 1.0, 0.0)));
    camera.up = glm::cross(right, camera.forward);
    camera.verticalFov = fovDegrees * base::kPi / 180.0;
    scene.cameras.push_back(std::move(camera));
}

}  // namespace fluxwalk::scene
