#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/surface/surface.h"

/// Control meshes of subdivision surfaces.
namespace fluxwalk::surface {

enum class SubdivisionScheme : std::uint8_t { catmullClark, loop };

/// Sharpness from which on an edge stays sharp for ever.
inline constexpr float kInfinitelySharp = 10.0f;

/// An edge, by its two vertices in any order, that is smoothed less: 0 is smooth, between that and
/// kInfinitelySharp it is sharp for so many levels of subdivision.
struct Crease {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    float sharpness = kInfinitelySharp;
};

/// A control mesh, faces counter-clockwise seen from the front. Boundary edges are kept (the surface ends in
/// the spline of the boundary's vertices), corners of one face alone are kept as points.
struct ControlCage {
    SubdivisionScheme scheme = SubdivisionScheme::catmullClark;
    std::vector<Vec3d> positions;
    /// Number of corners of each face (3 in the scheme of Loop), and the vertices of all corners, face by
    /// face.
    std::vector<std::uint32_t> faceSizes;
    std::vector<std::uint32_t> corners;
    std::vector<Crease> creases;
    /// Coordinates of the corners, parallel to `corners`, or empty.
    std::array<std::vector<base::Vec2>, 2> texcoords;
};

/// What makes a cage no control mesh, in words for its author: positions that are not finite, indices out of
/// range, faces with too few, too many (above 256) or repeated corners or without area, edges of more than
/// two faces or between faces that run in opposite directions, vertices without faces, with more than 256, or
/// where separate fans of faces meet. Empty where it is sound.
std::optional<std::string> findDefect(const ControlCage& cage);

/// The cage in its place. A map that mirrors keeps the front sides in front.
ControlCage transformCage(ControlCage cage, const base::Mat4d& map);

}  // namespace fluxwalk::surface
