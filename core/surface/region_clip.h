#pragma once

#include "core/surface/bezier_piece.h"

/// Regions in the coordinates of a part of their patch.
namespace fluxwalk::surface {

/// Rounding of parameters that are no dyadic fractions.
inline constexpr double kRegionRounding = 1e-12;

/// The region as seen from a part of the domain.
Region mapInto(const ParameterMap& part, const Region& region);

bool coversDomain(const Region& region, PatchDomain domain);
bool liesInDomain(const Region& region, PatchDomain domain);
/// Whether the interiors may meet; exact for regions with sides parallel to those of the domain.
bool overlapsDomain(const Region& region, PatchDomain domain);

/// A convex polygon.
struct ClippedRegion {
    std::array<Vec2d, 8> corners{};
    std::size_t count = 0;
};
/// What of a convex region lies in the domain.
ClippedRegion clipToDomain(const Region& region, PatchDomain domain);

/// True area in m2 of a polygon of 3 or 4 corners in a piece's coordinates, by 5 x 5 Gauss-Legendre points.
double integrateArea(const BezierPiece& piece, const Region& polygon);

}  // namespace fluxwalk::surface
