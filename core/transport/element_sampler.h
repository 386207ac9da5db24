#pragma once

#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::transport {

using base::NodeId;
using base::Vec3d;

/// Point of an element's true surface with its normal, towards the side that takes part, relative area
/// measure, and local coordinates (LocalFrame) in the order of that side's corners.
struct SurfaceSample {
    Vec3d position{};
    Vec3d normal{};
    double measure = 1.0;
    base::Vec2d local{0.0};
};

/// Points of one element; the hierarchy must stay as it is meanwhile.
class ElementSampler {
  public:
    /// `shift` in [0, 1), random: moves the strata of an element that is partly hidden, whose cells cannot
    /// all get the same number of them.
    ElementSampler(const hierarchy::Hierarchy& hierarchy, NodeId id, double shift = 0.5);

    /// Point at coordinates of the region's unit square.
    SurfaceSample at(const base::Vec2d& st) const;

    /// Middle of one of the 4 x 4 cells of Shape::exposedCells.
    SurfaceSample inCell(unsigned cell) const;

    /// Point of the exposed part in one of side x side strata, at (jx, jy) in [0, 1)^2 within it.
    SurfaceSample inStratum(unsigned stratum, unsigned side, double jx, double jy) const;

    /// Mean of SurfaceSample::measure over the unit square.
    double meanMeasure() const {
        return shape_.isPlanar ? 1.0 + 0.5 * (alongS_ + alongT_) : static_cast<double>(shape_.area);
    }

    /// The exposed part's point at coordinates of a unit square over its cells.
    SurfaceSample inExposed(const base::Vec2d& st) const;

  private:
    const hierarchy::Shape& shape_;
    const surface::Surface* surface_ = nullptr;  ///< of curved elements
    hierarchy::ElementName name_;
    surface::Region region_;
    std::array<Vec3d, 4> corners_{};
    Vec3d axis_{};
    /// Relative growth of a planar quad's area measure along its two coordinates: it is linear in each.
    double alongS_ = 0.0;
    double alongT_ = 0.0;
    double shift_;
    std::array<std::uint8_t, 16> cells_;  ///< the exposed ones, where not all are
    unsigned cellCount_ = 16;
};

}  // namespace fluxwalk::transport
