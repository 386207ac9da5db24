#pragma once

#include <array>
#include <span>

#include "core/surface/surface.h"

/// Angles of surfaces of revolution, counted in quarter turns, and what an arc of them bounds. A point at an
/// angle is (cos, sin); about the axis +Y that is (x, -z), from +X over -Z as texture coordinates run.
namespace fluxwalk::surface {

/// (cos, sin) of `quarter` + `part` quarter turns. The ends part = 0 and 1 are exact, so that neighbouring
/// quarters meet bitwise.
Vec2d turnAt(unsigned quarter, double part);

/// The quarter turn that holds a point of the plane.
unsigned quarterOf(const Vec2d& at);

/// Part in [0, 1] of a quarter turn that is nearest in angle to a point of the plane; 1/2 for the origin.
double partOfQuarter(unsigned quarter, const Vec2d& at);

/// Angles from part `from` to part `to` >= from of one quarter turn.
struct Arc {
    unsigned quarter = 0;
    double from = 0.0;
    double to = 1.0;
};

struct Interval {
    double lower = 0.0;
    double upper = 0.0;
};

/// Exact range of a cos + b sin over an arc.
Interval rangeOver(const Arc& arc, const Vec2d& ab);

/// Corners of a polygon that holds the arc's points: its ends and where the tangents of its halves meet.
std::array<Vec2d, 4> hullOf(const Arc& arc);

/// A cone about all combinations, with weights >= 0, of some directions of any length, a few percent wider
/// than the narrowest. They are at most 16. A cone no wider than `enough` (radians) is not narrowed further.
NormalCone coneAround(std::span<const Vec3d> directions, double enough = 0.0);

/// Whether coneAround() finds one no wider than `halfAngle` (radians) when that is enough, for less.
bool isWithinCone(std::span<const Vec3d> directions, double halfAngle);

/// Least box in (u,v) that holds a region, as its lower and upper corner.
std::array<Vec2d, 2> parameterBox(const Region& region);

/// Whether a region is a rectangle along u and v, as all are that come from quartering a quad.
bool isParameterBox(const Region& region);

}  // namespace fluxwalk::surface
