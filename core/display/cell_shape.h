#pragma once

#include <array>

#include "core/display/cell.h"

namespace fluxwalk::display {

/// A point of the surface as a patch sees it.
struct SurfaceSample {
    Vec2d uv{};
    Vec3d position{};
    Vec3d normal{};
    std::uint32_t patch = 0;
    std::uint32_t point = kNone;  ///< its number where it is a vertex; others are only looked at
    std::uint32_t next = kNone;   ///< at the same place, for another patch or other (u,v)
};
SurfaceSample sampleAt(const surface::Surface& surface, std::uint32_t patch, const Vec2d& uv);

/// A quad region of a surface at its corners, the middles of its edges and its middle: the points that its
/// triangles may join.
class CellShape {
  public:
    /// Corners and middles in turn around the border, then the middle. They stay.
    using Samples = std::array<const SurfaceSample*, 9>;
    explicit CellShape(const Samples& samples);

    /// Length of the longer edge along an axis, by way of its middle.
    double longestAlong(Axis axis) const;
    /// How far the normal turns along an axis, at most, in radians (small turns; larger ones are larger).
    double turnAlong(Axis axis) const;
    /// Whether two of its normals are more than `angle` apart (radians, below pi); others may be all the
    /// same.
    bool turnsBeyond(double angle) const;
    /// Rise of side k, between corners k and k + 1, over its chord.
    double riseOf(unsigned side) const;
    /// The same relative to half of the chord: tan(a / 2) for an arc that turns by 2 a.
    double bendOf(unsigned side) const;
    /// The same relative to the length across, where that is shorter.
    double riseOverWidth(unsigned side) const;
    /// Whether one end along the axis is a point, as at the pole of a disk and the apex of a cone.
    bool endsInPoint(Axis axis) const;
    /// Axis along which it is longer, if by more than `ratio`, in the mean over the edges.
    bool isLonger(Axis axis, double ratio) const;
    /// Whether an angle of its fan is below the one with this cosine, whatever hangs on its edges.
    bool hasAngleBelow(double cosine) const;

  private:
    const Vec3d& corner(unsigned k) const { return samples_[2 * (k % 4)]->position; }
    const Vec3d& middle(unsigned k) const { return samples_[2 * (k % 4) + 1]->position; }
    const Vec3d& normal(unsigned k) const { return samples_[k]->normal; }
    double lengthOf(unsigned side) const { return lengths_[side % 4]; }
    double meanAlong(Axis axis) const;

    Samples samples_;
    std::array<double, 4> lengths_;  ///< of the sides, by way of their middles
};

/// The samples of one quad region that are not kept.
struct QuadSamples {
    QuadSamples(const surface::Surface& surface, std::uint32_t patch, const surface::Region& region);
    CellShape::Samples pointers() const;

    std::array<SurfaceSample, 9> samples;
};

}  // namespace fluxwalk::display
