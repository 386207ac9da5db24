#include "core/transport/element_part.h"

#include "core/hierarchy/local_frame.h"

namespace fluxwalk::transport {

namespace {

using base::Vec2d;

// By parameters alone: such a part need not share its edges with others.
surface::Region quarterOf(const surface::Region& region, unsigned child) {
    const auto& c = region.corners;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) { return 0.5 * (c[i] + c[j]); };
    surface::Region part;
    part.cornerCount = region.cornerCount;
    if (region.cornerCount == 3 && child == 3) {
        part.corners = {middle(1, 2), middle(2, 0), middle(0, 1), middle(0, 1)};
        return part;
    }
    if (region.cornerCount == 3) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            part.corners[i] = middle(child, i);
        }
        part.corners[3] = part.corners[2];
        return part;
    }
    const Vec2d centre = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    const std::uint32_t next = (child + 1) % 4;
    const std::uint32_t before = (child + 3) % 4;
    part.corners[child] = c[child];
    part.corners[next] = middle(child, next);
    part.corners[(child + 2) % 4] = centre;
    part.corners[before] = middle(before, child);
    return part;
}

}  // namespace

surface::Region partRegion(const surface::Region& region, Path part) {
    surface::Region result = region;
    for (unsigned level = 0; level < surface::pathLevel(part); ++level) {
        result = quarterOf(result, surface::pathStep(part, level));
    }
    return result;
}

base::Vec2 partMiddle(std::uint32_t cornerCount, Path part) {
    const hierarchy::ChildFrame& quarters = hierarchy::childFrame(cornerCount, surface::Split::quarters);
    base::Vec2 middle(0.0f);
    base::Vec2 scale(1.0f);
    for (unsigned level = 0; level < surface::pathLevel(part); ++level) {
        const unsigned child = surface::pathStep(part, level);
        middle += scale * quarters.middle(child);
        scale *= quarters.scale(child);
    }
    return middle;
}

PartExposure partExposure(const hierarchy::Shape& shape, Path part) {
    if (shape.exposedCells == 0xffff) {
        return PartExposure::all;
    }
    if (shape.cornerCount == 3) {
        return PartExposure::some;
    }
    unsigned i = 0;
    unsigned j = 0;
    unsigned side = 4;
    for (unsigned level = 0; level < surface::pathLevel(part); ++level) {
        const unsigned child = surface::pathStep(part, level);
        side /= 2;
        i += child == 1 || child == 2 ? side : 0;
        j += child >= 2 ? side : 0;
    }
    unsigned exposed = 0;
    for (unsigned y = j; y < j + side; ++y) {
        for (unsigned x = i; x < i + side; ++x) {
            exposed += shape.exposedCells >> (4 * y + x) & 1u;
        }
    }
    return exposed == 0             ? PartExposure::none
           : exposed == side * side ? PartExposure::all
                                    : PartExposure::some;
}

SurfaceSample sampleRegion(const hierarchy::Hierarchy& hierarchy, NodeId element,
                           const surface::Region& region, const base::Vec2d& random) {
    const hierarchy::ElementName name = hierarchy.name(element);
    const surface::RegionPoint at = surface::mapToRegion(region, random);
    const surface::SurfacePoint p = hierarchy.surfaceOf(element).evaluate(name.patch, at.uv);
    return {p.position, name.back ? -p.normal : p.normal, p.jacobian * at.jacobian, Vec2d(0.0)};
}

}  // namespace fluxwalk::transport
