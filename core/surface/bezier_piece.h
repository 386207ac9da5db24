#pragma once

#include <array>
#include <cstdint>

#include "core/surface/surface.h"

/// Polynomial pieces of a surface in Bezier form, whose control points hold the piece in their convex hull:
/// what every certain bound below rests on.
namespace fluxwalk::surface {

/// Bicubic over the unit square (16 points, row by row along u), or quartic over the triangle u, v >= 0,
/// u + v <= 1 (15 points, rows along u of 5, 4, 3, 2 and 1; the last one unused).
struct BezierPiece {
    PatchDomain domain = PatchDomain::quad;
    std::array<Vec3d, 16> points{};
};

/// Index of a quartic triangle's point that belongs to u^i v^j.
constexpr std::size_t quarticIndex(std::size_t i, std::size_t j) {
    return j * 5 - j * (j - 1) / 2 + i;
}

/// Point of a piece and its derivatives.
struct Tangents {
    Vec3d position{};
    Vec3d du{};
    Vec3d dv{};
};

/// Affine map of a part's own coordinates (unit square or triangle) to those of a larger domain.
struct ParameterMap {
    Vec2d origin{0.0, 0.0};
    Vec2d du{1.0, 0.0};
    Vec2d dv{0.0, 1.0};

    Vec2d at(const Vec2d& st) const { return origin + st.x * du + st.y * dv; }
    /// Inverse of at().
    Vec2d inverse(const Vec2d& uv) const;
    /// The map of `part` within this one's domain to where this one leads.
    ParameterMap then(const ParameterMap& part) const;
    double determinant() const { return du.x * dv.y - du.y * dv.x; }
};

/// Quarter 0..3 of a domain, in the order of childRegions(): quads keep corner k, triangle 3 is the middle
/// one, turned by half a turn.
ParameterMap quarterMap(PatchDomain domain, unsigned quarter);

Tangents evaluatePiece(const BezierPiece& piece, const Vec2d& uv);

/// The same polynomials over a part of the domain: a parallelogram with sides along u and v, or any triangle.
BezierPiece restrictPiece(const BezierPiece& piece, const ParameterMap& part);

Box boundPiece(const BezierPiece& piece);

/// Cone of the normals du x dv. They are positive combinations of the product's own Bezier coefficients, so a
/// cone below a right angle about those holds them all; otherwise every direction.
NormalCone boundNormals(const BezierPiece& piece);

/// Whether that cone is no wider than `halfAngle` (radians), for less.
bool normalsLieWithin(const BezierPiece& piece, double halfAngle);

/// First-order model about the middle of the domain, and how far the derivatives stray from those there: the
/// largest distances of control vectors of du and of dv.
struct LinearModel {
    Tangents middle;
    double deviationU = 0.0;
    double deviationV = 0.0;
};
LinearModel linearize(const BezierPiece& piece);

/// Middle of a domain in its own coordinates.
constexpr Vec2d middleOf(PatchDomain domain) {
    return domain == PatchDomain::quad ? Vec2d(0.5) : Vec2d(1.0 / 3.0);
}

/// A parameter brought into the domain, or to `margin` from it.
Vec2d clampToDomain(PatchDomain domain, const Vec2d& st, double margin);

/// Whether the surface of the piece bends away from every normal within `normals` (sign 1), or towards it
/// (sign -1), in every direction of its parameters: its second derivatives along the normal form a matrix
/// that is negative (positive) semidefinite, up to `tolerance` metres.
bool bendsAway(const BezierPiece& piece, const NormalCone& normals, double sign, double tolerance);

}  // namespace fluxwalk::surface
