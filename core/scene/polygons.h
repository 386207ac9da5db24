#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/scene/scene.h"

/// Parts from which the built-in scenes are made: quads and boxes of one object, plain materials, cameras.
namespace fluxwalk::scene {

/// Corners counter-clockwise seen from the front.
using Quad = std::array<Vec3d, 4>;
using Quads = std::vector<Quad>;

/// Faces of an axis-aligned box; may be combined.
enum BoxFace : unsigned {
    kLeft = 1,    ///< -x
    kRight = 2,   ///< +x
    kBottom = 4,  ///< -y
    kTop = 8,     ///< +y
    kNear = 16,   ///< -z
    kFar = 32,    ///< +z
    kAround = kLeft | kRight | kNear | kFar,
    kStanding = kAround | kTop,
    kAllFaces = kStanding | kBottom
};

/// The chosen faces of a box, fronts outwards (inwards for a room).
Quads boxFaces(const Vec3d& lower, const Vec3d& upper, unsigned faces = kAllFaces, bool inwards = false);

/// One quad cut into a grid of `columns` along its first edge and `rows` along its last.
Quads gridOf(const Quad& quad, unsigned columns, unsigned rows);

/// Joins lists of quads in order.
Quads join(std::initializer_list<Quads> parts);

/// Adds an object of planar quads; each quad becomes one patch, in order, unless it is not planar (then two:
/// its diagonal runs from corner 0 to corner 2).
void addPolygons(Scene& scene, std::string name, std::uint32_t material, const Quads& quads);

/// The same with texture coordinates (set 0), which must be an affine function of the place on each quad.
void addTexturedPolygons(Scene& scene, std::string name, std::uint32_t material, const Quads& quads,
                         const std::function<base::Vec2(const Vec3d& place)>& texcoordAt);

/// Adds a material and returns its index.
std::uint32_t addMaterial(Scene& scene, std::string name, const Rgb& reflectance,
                          const Rgb& emission = Rgb(0.0f));

/// Adds a camera that looks from `eye` to `target`, y up; field of view in degrees.
void addCamera(Scene& scene, std::string name, const Vec3d& eye, const Vec3d& target, double fovDegrees);

}  // namespace fluxwalk::scene
