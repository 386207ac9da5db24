#pragma once

#include <span>
#include <string>

#include "core/scene/scene.h"
#include "core/surface/control_cage.h"

/// Curved parts from which the built-in scenes are made. Sizes in metres; upright unless a map turns them.
namespace fluxwalk::scene {

void addSphere(Scene& scene, std::string name, std::uint32_t material, const Vec3d& center, double radius);

/// Open cylinder that stands on `foot`.
void addCylinder(Scene& scene, std::string name, std::uint32_t material, const Vec3d& foot, double radius,
                 double height);

/// Open frustum that stands on `foot`.
void addCone(Scene& scene, std::string name, std::uint32_t material, const Vec3d& foot, double radiusBottom,
             double radiusTop, double height);

/// Disk or annulus that faces upwards.
void addDisk(Scene& scene, std::string name, std::uint32_t material, const Vec3d& center, double radius,
             double innerRadius = 0.0);

/// Torus whose ring lies flat.
void addTorus(Scene& scene, std::string name, std::uint32_t material, const Vec3d& center, double majorRadius,
              double minorRadius);

/// Moves the origin to `place` and turns +Y onto `axis` (unit and level), +X downwards.
base::Mat4d turnTo(const Vec3d& axis, const Vec3d& place);

void addSurface(Scene& scene, std::string name, std::uint32_t material,
                std::shared_ptr<const surface::Surface> surface);
void addSubdivision(Scene& scene, std::string name, std::uint32_t material, const surface::ControlCage& cage);

/// Ring of a turned body: distance from its axis, and height.
struct LatheRing {
    double radius = 0.0;
    double height = 0.0;
};

/// Catmull-Clark cage of a turned body about the vertical through `foot`, open at both ends: rings from below
/// upwards in `segments` faces each. The limit surface's horizontal sections have the rings' radii (smoothed
/// from ring to ring, which the first and last keep), round to .5 % with six segments.
surface::ControlCage turnCage(const Vec3d& foot, std::span<const LatheRing> rings, unsigned segments);

}  // namespace fluxwalk::scene
