#include "core/scene/shapes.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"
#include "core/surface/sphere.h"
#include "core/surface/subdivision_surface.h"
#include "core/surface/torus.h"

namespace fluxwalk::scene {

namespace {

base::Mat4d moveTo(const Vec3d& place) {
    return glm::translate(base::Mat4d(1.0), place);
}

}  // namespace

void addSurface(Scene& scene, std::string name, std::uint32_t material,
                std::shared_ptr<const surface::Surface> surface) {
    scene.objects.push_back({std::move(name), std::move(surface), material});
}

base::Mat4d turnTo(const Vec3d& axis, const Vec3d& place) {
    const Vec3d down(0.0, -1.0, 0.0);
    return base::Mat4d(glm::dvec4(down, 0.0), glm::dvec4(axis, 0.0), glm::dvec4(glm::cross(down, axis), 0.0),
                       glm::dvec4(place, 1.0));
}

void addSphere(Scene& scene, std::string name, std::uint32_t material, const Vec3d& center, double radius) {
    addSurface(scene, std::move(name), material, std::make_shared<surface::Sphere>(center, radius));
}

void addCylinder(Scene& scene, std::string name, std::uint32_t material, const Vec3d& foot, double radius,
                 double height) {
    const Vec3d middle = foot + Vec3d(0.0, 0.5 * height, 0.0);
    addSurface(scene, std::move(name), material,
               std::make_shared<surface::Cylinder>(moveTo(middle), radius, height));
}

void addCone(Scene& scene, std::string name, std::uint32_t material, const Vec3d& foot, double radiusBottom,
             double radiusTop, double height) {
    const Vec3d middle = foot + Vec3d(0.0, 0.5 * height, 0.0);
    addSurface(scene, std::move(name), material,
               std::make_shared<surface::Cone>(moveTo(middle), radiusBottom, radiusTop, height));
}

void addDisk(Scene& scene, std::string name, std::uint32_t material, const Vec3d& center, double radius,
             double innerRadius) {
    addSurface(scene, std::move(name), material,
               std::make_shared<surface::Disk>(moveTo(center), radius, innerRadius));
}

void addTorus(Scene& scene, std::string name, std::uint32_t material, const Vec3d& center, double majorRadius,
              double minorRadius) {
    addSurface(scene, std::move(name), material,
               std::make_shared<surface::Torus>(moveTo(center), majorRadius, minorRadius));
}

void addSubdivision(Scene& scene, std::string name, std::uint32_t material,
                    const surface::ControlCage& cage) {
    FLUXWALK_CHECK(!surface::findDefect(cage));
    addSurface(scene, std::move(name), material, std::make_shared<surface::SubdivisionSurface>(cage));
}

surface::ControlCage turnCage(const Vec3d& foot, std::span<const LatheRing> rings, unsigned segments) {
    FLUXWALK_CHECK_LT(2u, segments);
    FLUXWALK_CHECK_LT(std::size_t{1}, rings.size());
    // A closed uniform cubic B-spline through n points of a circle has 1/6 (4 + 2 cos(2 pi / n)) of its
    // radius.
    const double step = 2.0 * base::kPi / segments;
    const double growth = 6.0 / (4.0 + 2.0 * std::cos(step));
    surface::ControlCage cage;
    for (const LatheRing& ring : rings) {
        for (unsigned i = 0; i < segments; ++i) {
            // In float, as files keep them.
            cage.positions.emplace_back(
                base::Vec3(foot + Vec3d(growth * ring.radius * std::cos(i * step), ring.height,
                                        -growth * ring.radius * std::sin(i * step))));
        }
    }
    for (std::uint32_t j = 0; j + 1 < rings.size(); ++j) {
        for (std::uint32_t i = 0; i < segments; ++i) {
            const std::uint32_t next = (i + 1) % segments;
            cage.faceSizes.push_back(4);
            cage.corners.insert(cage.corners.end(), {j * segments + i, j * segments + next,
                                                     (j + 1) * segments + next, (j + 1) * segments + i});
        }
    }
    return cage;
}

}  // namespace fluxwalk::scene
