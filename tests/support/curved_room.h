#pragma once

#include <memory>
#include <numbers>

#include "core/scene/polygons.h"
#include "core/surface/cylinder.h"
#include "core/surface/sphere.h"
#include "core/surface/subdivision_surface.h"
#include "core/surface/torus.h"

/// A scene of curved objects that light reaches from one side.
namespace fluxwalk::test {

/// A vase as a potter's lathe makes it: `sides` faces around, four rings of them above an n-gon that closes
/// it. Radius 1 at its widest, 3 high, on the origin; open above.
inline surface::ControlCage latheCage(std::uint32_t sides) {
    constexpr std::array<double, 5> kRadius{0.65, 1.2, 0.95, 0.4, 0.75};
    constexpr std::array<double, 5> kHeight{0.0, 0.75, 1.6, 2.3, 3.0};
    surface::ControlCage cage;
    for (std::size_t ring = 0; ring < kRadius.size(); ++ring) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double a = 2.0 * std::numbers::pi * i / sides;
            cage.positions.emplace_back(kRadius[ring] * std::cos(a), kHeight[ring],
                                        -kRadius[ring] * std::sin(a));
        }
    }
    const auto addFace = [&cage](std::initializer_list<std::uint32_t> corners) {
        cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
        cage.corners.insert(cage.corners.end(), corners);
    };
    for (std::uint32_t ring = 0; ring + 1 < kRadius.size(); ++ring) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t next = (i + 1) % sides;
            addFace(
                {ring * sides + i, ring * sides + next, (ring + 1) * sides + next, (ring + 1) * sides + i});
        }
    }
    cage.faceSizes.push_back(sides);
    for (std::uint32_t i = 0; i < sides; ++i) {
        cage.corners.push_back(sides - 1 - i);
    }
    return cage;
}

/// A map that scales, turns about +X by `tilt` radians and then moves.
inline base::Mat4d placeAt(const base::Vec3d& position, double scale, double tilt = 0.0) {
    base::Mat4d place(1.0);
    place[0] = {scale, 0.0, 0.0, 0.0};
    place[1] = {0.0, scale * std::cos(tilt), scale * std::sin(tilt), 0.0};
    place[2] = {0.0, -scale * std::sin(tilt), scale * std::cos(tilt), 0.0};
    place[3] = {position, 1.0};
    return place;
}

/// A closed room of 5 m x 3 m x 5 m with a lamp to one side and, half in its light, a sphere, a leaning
/// torus, two columns from floor to ceiling and a vase on a plinth. Objects, in this order: room, lamp,
/// plinth, sphere, torus, column, column, vase.
inline scene::Scene buildCurvedRoom() {
    scene::Scene scene;
    scene.name = "curved-room";
    using base::Rgb;
    const std::uint32_t walls = scene::addMaterial(scene, "plaster", {0.72f, 0.70f, 0.64f});
    // 4,000 lm from a panel of 1 m x 1 m.
    const std::uint32_t lamp =
        scene::addMaterial(scene, "lamp", Rgb(0.6f), Rgb(1.04f, 1.0f, 0.88f) * 4000.0f);
    const std::uint32_t stone = scene::addMaterial(scene, "stone", Rgb(0.45f));
    const std::uint32_t glaze = scene::addMaterial(scene, "glaze", {0.25f, 0.45f, 0.6f});
    const std::uint32_t clay = scene::addMaterial(scene, "clay", {0.6f, 0.35f, 0.25f});
    scene::addPolygons(scene, "room", walls,
                       scene::boxFaces(base::Vec3d(0.0), {5.0, 3.0, 5.0}, scene::kAllFaces, true));
    scene::addPolygons(scene, "lamp", lamp,
                       scene::boxFaces({0.6, 2.9, 1.2}, {1.6, 2.9, 2.2}, scene::kBottom));
    scene::addPolygons(scene, "plinth", stone,
                       scene::boxFaces({2.6, 0.0, 3.0}, {3.2, 0.5, 3.6}, scene::kStanding));
    const auto add = [&scene](const char* name, std::shared_ptr<const surface::Surface> surface,
                              std::uint32_t material) {
        scene.objects.push_back({name, std::move(surface), material});
    };
    add("sphere", std::make_shared<surface::Sphere>(base::Vec3d(2.4, 0.9, 1.4), 0.5), glaze);
    add("torus", std::make_shared<surface::Torus>(placeAt({3.9, 0.8, 1.5}, 1.0, 0.9), 0.5, 0.2), clay);
    for (const double x : {0.9, 4.2}) {
        add("column", std::make_shared<surface::Cylinder>(placeAt({x, 1.5, 3.6}, 1.0), 0.2, 3.0), stone);
    }
    add("vase",
        std::make_shared<surface::SubdivisionSurface>(
            surface::transformCage(latheCage(6), placeAt({2.9, 0.48, 3.3}, 0.3))),
        clay);
    scene::addCamera(scene, "door", {0.4, 1.6, 4.6}, {3.2, 0.9, 2.0}, 60.0);
    return scene;
}

}  // namespace fluxwalk::test
