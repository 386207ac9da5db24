#include "core/solve/cluster_pairs.h"

#include <algorithm>
#include <limits>

#include "core/base/photometry.h"

namespace fluxwalk::solve {

using base::NodeId;
using hierarchy::Shape;

bool areApart(const hierarchy::Hierarchy& h, NodeId a, NodeId b) {
    const Shape& shapeA = h.shape(a);
    const Shape& shapeB = h.shape(b);
    if (shapeA.cornerCount == 0 && shapeB.cornerCount == 0) {
        return glm::distance(shapeA.center, shapeB.center) > shapeA.radius + shapeB.radius;
    }
    const Shape& cluster = shapeA.cornerCount == 0 ? shapeA : shapeB;
    const Shape& element = shapeA.cornerCount == 0 ? shapeB : shapeA;
    hierarchy::Extent box{element.center - element.radius, element.center + element.radius};
    if (element.isPlanar) {
        box = {element.corners[0], element.corners[0]};
        for (std::uint32_t i = 1; i < element.cornerCount; ++i) {
            box.lower = glm::min(box.lower, element.corners[i]);
            box.upper = glm::max(box.upper, element.corners[i]);
        }
    }
    const base::Vec3 nearest = glm::clamp(cluster.center, box.lower, box.upper);
    return glm::distance(nearest, cluster.center) > cluster.radius;
}

float boundExchange(const hierarchy::Hierarchy& h, NodeId a, NodeId b) {
    const auto radiosity = [&h](NodeId id) {
        const hierarchy::Light& light = h.light(id);
        return base::channelMean(light.radiosity) + light.range();
    };
    const float area = std::min(h.shape(a).exposedArea(), h.shape(b).exposedArea());
    return std::min(area * std::max(radiosity(a), radiosity(b)) / static_cast<float>(h.totalArea()),
                    std::numeric_limits<float>::max());
}

}  // namespace fluxwalk::solve
