#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/base/photometry.h"
#include "core/base/random.h"
#include "core/surface/cone.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"
#include "core/surface/region.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"

/// Every curved shape, for the tests that all must pass, and the maps they are placed by.
namespace fluxwalk::test {

using base::Mat4d;
using base::Vec2d;
using base::Vec3d;
using surface::Region;
using surface::Surface;
using SurfacePtr = std::shared_ptr<const Surface>;

struct CurvedShape {
    std::string name;
    std::function<SurfacePtr(const Mat4d& worldFromLocal, bool inside)> make;
    /// Edges that two different patches share.
    int sharedEdgeCount = 0;
};

inline std::ostream& operator<<(std::ostream& out, const CurvedShape& shape) {
    return out << shape.name;
}

/// A new shape joins all tests by a line here.
inline std::vector<CurvedShape> curvedShapes() {
    using namespace surface;
    const auto shared = [](auto made) -> SurfacePtr {
        return std::make_shared<const decltype(made)>(std::move(made));
    };
    return {
        {"sphere", [=](const Mat4d& m, bool in) { return shared(Sphere(m, in)); }, 12},
        {"cylinder", [=](const Mat4d& m, bool in) { return shared(Cylinder(m, .7, 1.9, in)); }, 4},
        {"flatCylinder", [=](const Mat4d& m, bool in) { return shared(Cylinder(m, 1.3, .05, in)); }, 4},
        {"cone", [=](const Mat4d& m, bool in) { return shared(Cone(m, .8, 0, 1.5, in)); }, 4},
        {"coneUpsideDown", [=](const Mat4d& m, bool in) { return shared(Cone(m, 0, .6, .4, in)); }, 4},
        {"frustum", [=](const Mat4d& m, bool in) { return shared(Cone(m, .9, .35, 1.1, in)); }, 4},
        {"needle", [=](const Mat4d& m, bool in) { return shared(Cone(m, .05, .001, 2, in)); }, 4},
        {"disk", [=](const Mat4d& m, bool in) { return shared(Disk(m, 1.2, 0, in)); }, 4},
        {"annulus", [=](const Mat4d& m, bool in) { return shared(Disk(m, 1.2, .5, in)); }, 4},
        {"torus", [=](const Mat4d& m, bool in) { return shared(Torus(m, 1.1, .4, in)); }, 32},
        {"thinTorus", [=](const Mat4d& m, bool in) { return shared(Torus(m, 1.3, .01, in)); }, 32},
        {"fatTorus", [=](const Mat4d& m, bool in) { return shared(Torus(m, .7, .69, in)); }, 32},
    };
}

/// A shape somewhere in the world.
struct Placed {
    std::string name;
    SurfacePtr surface;
};

inline Mat4d randomRotation(base::RandomStream& random) {
    const auto direction = [&random] {
        const double y = 1.0 - 2.0 * random.next();
        const double angle = 2.0 * base::kPi * random.next();
        const double flat = std::sqrt(1.0 - y * y);
        return Vec3d(flat * std::cos(angle), y, flat * std::sin(angle));
    };
    const Vec3d a = direction();
    const Vec3d b = glm::normalize(glm::cross(a, direction()));
    Mat4d m(1.0);
    m[0] = {a, 0};
    m[1] = {b, 0};
    m[2] = {glm::cross(a, b), 0};
    return m;
}

/// A shape as it is, under random similarities, and under random affine maps of condition up to 10 or so;
/// mirrored or not, inside out or not.
inline std::vector<Placed> placements(const CurvedShape& shape, std::uint64_t key = 7) {
    base::RandomStream random(base::combine(key, shape.name.size()));
    std::vector<Placed> all;
    for (const bool inside : {false, true}) {
        const std::string side = inside ? " inside" : "";
        all.push_back({shape.name + side, shape.make(Mat4d(1.0), inside)});
        for (const bool mirror : {false, true}) {
            Mat4d similar = randomRotation(random);
            Mat4d scale(1.0);
            const double size = .3 + 2.0 * random.next();
            for (int i = 0; i < 3; ++i) {
                similar[i] *= size;
                scale[i][i] = .4 + 2.0 * random.next();
            }
            Mat4d affine = randomRotation(random) * scale * randomRotation(random);
            similar[3] = {random.next() - 3.0, random.next() + 2.0, random.next(), 1};
            affine[3] = {random.next() + 1.0, random.next() - 4.0, random.next(), 1};
            if (mirror) {
                similar[0] = -similar[0];
                affine[2] = -affine[2];
            }
            const std::string how = side + (mirror ? " mirrored" : "");
            all.push_back({shape.name + how + " similar", shape.make(similar, inside)});
            all.push_back({shape.name + how + " affine", shape.make(affine, inside)});
        }
    }
    return all;
}

/// A random element of a patch, at most `deepest` levels down.
inline Region randomElement(const Surface& surface, std::uint32_t patch, unsigned deepest,
                            base::RandomStream& random) {
    surface::Path path = surface::kRootPath;
    const auto levels = static_cast<unsigned>(random.next() * (deepest + 1));
    for (unsigned level = 0; level < levels; ++level) {
        path = surface::childPath(path, static_cast<unsigned>(random.next() * 4.0));
    }
    return surface::regionOf(surface, patch, path);
}

inline std::uint32_t randomPatch(const Surface& surface, base::RandomStream& random) {
    return static_cast<std::uint32_t>(random.next() * surface.patchCount());
}

}  // namespace fluxwalk::test
