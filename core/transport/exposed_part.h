#pragma once

#include <functional>

#include "core/transport/element_sampler.h"

/// Partly hidden elements: what lies inside another solid neither receives nor sends.
namespace fluxwalk::transport {

/// A function's integral over an element's exposed cells as a part of that over all, and the function's
/// gradient over the exposed ones in local coordinates (LocalFrame), relative to their mean.
struct ExposedPart {
    double share = 1.0;
    base::Vec2d gradient{0.0};
};

/// What of `kernel(SurfaceSample)` is left by the exposed ones of the 4 x 4 cells of Shape::exposedCells.
/// What is hidden under a solid is often out of the other end's sight anyway, so the share is seldom that of
/// the areas.
ExposedPart findExposedPart(const hierarchy::Hierarchy& hierarchy, NodeId id,
                            const std::function<double(const SurfaceSample&)>& kernel);

inline bool isPartlyHidden(const hierarchy::Shape& shape) {
    return shape.exposedCells != 0xffff;
}

}  // namespace fluxwalk::transport
