#pragma once

#include <span>

#include "core/base/vec.h"

/// Form factors in closed form or to quadrature error near rounding, without occlusion. Polygons are planar,
/// need not be convex, and have their corners counter-clockwise seen from the front, which emits and
/// receives.
namespace fluxwalk::transport {

using base::Vec3d;

/// F(x<-polygon): irradiance at point `x` with unit normal `normal` from a polygon of radiosity 1. The part
/// below the horizon of x does not count; 0 where x is behind the polygon. (Lambert 1760.)
double pointToPolygon(const Vec3d& x, const Vec3d& normal, std::span<const Vec3d> polygon);

/// F(x<-disc) of a disc that emits on the side of its unit normal.
double pointToDisc(const Vec3d& x, const Vec3d& normal, const Vec3d& center, const Vec3d& discNormal,
                   double radius);

/// F(x<-sphere) of the outside of a sphere; 0 where x is inside it.
double pointToSphere(const Vec3d& x, const Vec3d& normal, const Vec3d& center, double radius);

/// Coupling g = A_a F(a<-b) = A_b F(b<-a) in m2 of two polygons. Parts behind the plane of the other are
/// clipped, the rest is the double contour integral, which is regular also where they share corners or edges.
double polygonCoupling(std::span<const Vec3d> a, std::span<const Vec3d> b);

/// Area of a planar polygon in m2.
double polygonArea(std::span<const Vec3d> polygon);

}  // namespace fluxwalk::transport
