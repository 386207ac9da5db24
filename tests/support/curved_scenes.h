#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/scene/polygons.h"
#include "core/surface/cone.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"
#include "core/surface/dual_cage.h"
#include "core/surface/projected_surface.h"
#include "core/surface/sphere.h"
#include "core/surface/subdivision_surface.h"
#include "core/surface/torus.h"

/// Closed scenes of every curved shape, all of whose surfaces reflect and glow alike.
namespace fluxwalk::test {

using base::Mat4d;
using base::Rgb;
using base::Vec3d;
using scene::Scene;
using SurfacePtr = std::shared_ptr<const surface::Surface>;

inline Mat4d movedTo(const Vec3d& where) {
    Mat4d m(1.0);
    m[3] = glm::dvec4(where, 1.0);
    return m;
}

/// A rotation, so that nothing lies along the axes of the room, and a place.
inline Mat4d leaningAt(const Vec3d& where) {
    const Vec3d y = glm::normalize(Vec3d(.3, 1.0, -.2));
    const Vec3d x = glm::normalize(glm::cross(y, Vec3d(.4, .1, 1.0)));
    Mat4d m(1.0);
    m[0] = {x, 0};
    m[1] = {y, 0};
    m[2] = {glm::cross(x, y), 0};
    m[3] = {where, 1};
    return m;
}

/// Rings of quads turned on a lathe about the y axis, closed by one face above and one below.
inline surface::ControlCage closedVaseCage() {
    constexpr std::uint32_t kSides = 6;
    constexpr std::array<double, 6> kRadius{.16, .30, .32, .14, .15, .24};
    constexpr std::array<double, 6> kHeight{-.40, -.30, .0, .25, .32, .42};
    surface::ControlCage cage;
    for (std::uint32_t j = 0; j < kRadius.size(); ++j) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const double a = 2.0 * base::kPi * i / kSides;
            cage.positions.emplace_back(kRadius[j] * std::cos(a), kHeight[j], -kRadius[j] * std::sin(a));
        }
    }
    const auto addFace = [&cage](const std::vector<std::uint32_t>& corners) {
        cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
        cage.corners.insert(cage.corners.end(), corners.begin(), corners.end());
    };
    std::vector<std::uint32_t> top;
    std::vector<std::uint32_t> bottom;
    constexpr std::uint32_t kLast = static_cast<std::uint32_t>(kRadius.size() - 1) * kSides;
    for (std::uint32_t i = 0; i < kSides; ++i) {
        top.push_back(kLast + i);
        bottom.push_back(kSides - 1 - i);
        const std::uint32_t k = (i + 1) % kSides;
        for (std::uint32_t j = 0; j + 1 < kRadius.size(); ++j) {
            addFace({j * kSides + i, j * kSides + k, (j + 1) * kSides + k, (j + 1) * kSides + i});
        }
    }
    addFace(top);
    addFace(bottom);
    return cage;
}

/// The cage with its fronts turned inwards.
inline surface::ControlCage turnedInside(surface::ControlCage cage) {
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        std::reverse(cage.corners.begin() + static_cast<std::ptrdiff_t>(first),
                     cage.corners.begin() + static_cast<std::ptrdiff_t>(first + size));
        first += size;
    }
    return cage;
}

inline void addCurved(Scene& scene, std::string name, SurfacePtr surface) {
    scene.objects.push_back({std::move(name), std::move(surface), 0});
}

/// A cylinder about y with its two disks.
inline void addCappedCylinder(Scene& scene, const Mat4d& place, double radius, double height, bool inside) {
    const auto cap = [&](double y, bool facesDown) {
        Mat4d m = place * movedTo({0, y, 0});
        return std::make_shared<const surface::Disk>(m, radius, 0.0, facesDown);
    };
    addCurved(scene, "cylinder", std::make_shared<const surface::Cylinder>(place, radius, height, inside));
    addCurved(scene, "upper cap", cap(.5 * height, inside));
    addCurved(scene, "lower cap", cap(-.5 * height, !inside));
}

/// Reflectance .5 and 1 lm/m2 everywhere: B = 2.
inline Scene glowingScene(std::string name) {
    Scene scene;
    scene.name = std::move(name);
    scene::addMaterial(scene, "glowing", Rgb(.5f), Rgb(1.0f));
    return scene;
}

struct CurvedScene {
    std::string name;
    std::function<void(Scene&)> fill;
    double leafArea = 0.0;  ///< m2: no larger element is a leaf
};

inline std::ostream& operator<<(std::ostream& out, const CurvedScene& scene) {
    return out << scene.name;
}

inline void addRoom(Scene& scene) {
    scene::addPolygons(scene, "room", 0, scene::boxFaces(Vec3d(-.6), Vec3d(.6), scene::kAllFaces, true));
}

/// A closed room with one solid of each curved kind inside.
inline std::vector<CurvedScene> roomsWithSolids() {
    const auto withRoom = [](std::string name, double leafArea, std::function<void(Scene&)> add) {
        return CurvedScene{std::move(name),
                           [add = std::move(add)](Scene& scene) {
                               addRoom(scene);
                               add(scene);
                           },
                           leafArea};
    };
    const Vec3d middle(.03, -.02, .05);
    return {
        withRoom("sphere", .04,
                 [=](Scene& s) { addCurved(s, "sphere", std::make_shared<surface::Sphere>(middle, .35)); }),
        withRoom("cylinder", .04, [=](Scene& s) { addCappedCylinder(s, leaningAt(middle), .25, .6, false); }),
        withRoom("cone", .04,
                 [=](Scene& s) {
                     const Mat4d place = leaningAt(middle);
                     addCurved(s, "cone", std::make_shared<surface::Cone>(place, .35, 0.0, .6));
                     addCurved(s, "base",
                               std::make_shared<surface::Disk>(place * movedTo({0, -.3, 0}), .35, 0.0, true));
                 }),
        withRoom("torus", .03,
                 [=](Scene& s) {
                     addCurved(s, "torus", std::make_shared<surface::Torus>(leaningAt(middle), .32, .12));
                 }),
        withRoom("vase", .04,
                 [=](Scene& s) {
                     addCurved(s, "vase",
                               std::make_shared<surface::SubdivisionSurface>(
                                   transformCage(closedVaseCage(), leaningAt(middle))));
                 }),
        withRoom("smoothUnion", .04,
                 [=](Scene& s) {
                     const auto balls = std::make_shared<const surface::SmoothUnion>(
                         std::vector<surface::Ball>{{{-.15, -.1, .05}, .22}, {{.14, .08, 0}, .2}});
                     auto cage = surface::buildDualCage(balls);
                     FLUXWALK_CHECK(cage.has_value());
                     addCurved(s, "union",
                               std::make_shared<surface::ProjectedSurface>(balls, std::move(*cage)));
                 }),
    };
}

/// Curved shapes seen from inside.
inline std::vector<CurvedScene> hollows() {
    return {
        {"insideOfCylinder",
         [](Scene& s) {
             addCappedCylinder(s, leaningAt({1, 2, 3}), .5, 1.2, true);
         },
         .04},
        {"insideOfTorus",
         [](Scene& s) {
             addCurved(s, "torus", std::make_shared<surface::Torus>(leaningAt({1, 2, 3}), .5, .25, true));
         },
         .025},
        {"insideOfVase",
         [](Scene& s) {
             addCurved(s, "vase",
                       std::make_shared<surface::SubdivisionSurface>(
                           transformCage(turnedInside(closedVaseCage()), leaningAt({1, 2, 3}))));
         },
         .012},
    };
}

}  // namespace fluxwalk::test
