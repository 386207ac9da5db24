#pragma once

#include "core/transport/element_sampler.h"

/// Parts of an element that are finer than the hierarchy: for points so near that the element's curvature, or
/// the slope of its light, is seen within it.
namespace fluxwalk::transport {

/// Name of a part below its element: quarters of the region, child k at its corner k (of triangles child 3 in
/// the middle), whatever way the element itself would be cut.
using surface::Path;
/// Quarters of quarters are the cells of Shape::exposedCells.
inline constexpr unsigned kMaxPartLevel = 2;

surface::Region partRegion(const surface::Region& region, Path part);

/// Middle of a part in the element's local coordinates (LocalFrame).
base::Vec2 partMiddle(std::uint32_t cornerCount, Path part);

enum class PartExposure { none, some, all };
/// Which of a quad's cells in a part are exposed. Cells of triangles are no parts of theirs: `some` for all
/// parts of one that is partly hidden.
PartExposure partExposure(const hierarchy::Shape& shape, Path part);

/// Point of an element's region, or of a part's, for two numbers in [0, 1). `measure` is the region's area in
/// m2, in the mean.
SurfaceSample sampleRegion(const hierarchy::Hierarchy& hierarchy, NodeId element,
                           const surface::Region& region, const base::Vec2d& random);

}  // namespace fluxwalk::transport
