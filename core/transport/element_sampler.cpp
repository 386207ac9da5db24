#include "core/transport/element_sampler.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::transport {

ElementSampler::ElementSampler(const hierarchy::Hierarchy& hierarchy, NodeId id, double shift)
    : shape_(hierarchy.shape(id)), name_(hierarchy.name(id)), axis_(hierarchy.shape(id).axis), shift_(shift) {
    if (!shape_.isPlanar) {
        surface_ = &hierarchy.surfaceOf(id);
        region_ = hierarchy.region(id);
    }
    if (shape_.exposedCells != 0xffff) {
        cellCount_ = 0;
        for (unsigned cell = 0; cell < 16; ++cell) {
            if ((shape_.exposedCells >> cell & 1u) != 0) {
                cells_[cellCount_++] = static_cast<std::uint8_t>(cell);
            }
        }
    }
    for (std::uint32_t i = 0; i < shape_.cornerCount; ++i) {
        corners_[i] = Vec3d(shape_.corners[i]);
    }
    if (shape_.isPlanar && shape_.cornerCount == 4) {
        const auto& c = corners_;
        const double atStart = glm::length(glm::cross(c[1] - c[0], c[3] - c[0]));
        alongS_ = glm::length(glm::cross(c[1] - c[0], c[2] - c[1])) / atStart - 1.0;
        alongT_ = glm::length(glm::cross(c[2] - c[3], c[3] - c[0])) / atStart - 1.0;
    }
}

SurfaceSample ElementSampler::at(const base::Vec2d& st) const {
    // Corners of a back side run the other way round, which mirrors the region's second coordinate.
    const double s = st.x;
    const double t = name_.back ? 1.0 - st.y : st.y;
    const bool isTriangle = shape_.cornerCount == 3;
    const double root = isTriangle ? std::sqrt(s) : 0.0;
    const base::Vec2d local = isTriangle ? base::Vec2d(1.0 - root, t * root) - base::Vec2d(1.0 / 3.0)
                                         : base::Vec2d(2.0 * s - 1.0, 2.0 * t - 1.0);
    if (!shape_.isPlanar) {
        const surface::RegionPoint where = surface::mapToRegion(region_, st);
        const surface::SurfacePoint p = surface_->evaluate(name_.patch, where.uv);
        return {p.position, name_.back ? -p.normal : p.normal, p.jacobian * where.jacobian, local};
    }
    const auto& c = corners_;
    if (isTriangle) {
        return {(root * (1.0 - t)) * c[0] + (1.0 - root) * c[1] + (t * root) * c[2], axis_, 1.0, local};
    }
    return {(1.0 - t) * ((1.0 - s) * c[0] + s * c[1]) + t * ((1.0 - s) * c[3] + s * c[2]), axis_,
            1.0 + s * alongS_ + t * alongT_, local};
}

SurfaceSample ElementSampler::inCell(unsigned cell) const {
    const unsigned row = cell / 4;
    return at({(cell % 4 + 0.5) * 0.25, (row + 0.5) * 0.25});
}

SurfaceSample ElementSampler::inStratum(unsigned stratum, unsigned side, double jx, double jy) const {
    if (cellCount_ == 16) {
        const unsigned row = stratum / side;
        return at({(stratum % side + jx) / side, (row + jy) / side});
    }
    const double place = (stratum + shift_) * cellCount_ / (static_cast<double>(side) * side);
    const unsigned cell = cells_[std::min(cellCount_ - 1, static_cast<unsigned>(place))];
    const unsigned row = cell / 4;
    return at({(cell % 4 + jx) * 0.25, (row + jy) * 0.25});
}

SurfaceSample ElementSampler::inExposed(const base::Vec2d& st) const {
    if (cellCount_ == 16) {
        return at(st);
    }
    const double place = st.x * cellCount_;
    const unsigned chosen = std::min(cellCount_ - 1, static_cast<unsigned>(place));
    const unsigned cell = cells_[chosen];
    return at({(cell % 4 + place - chosen) * 0.25, (cell / 4 + st.y) * 0.25});
}

}  // namespace fluxwalk::transport
