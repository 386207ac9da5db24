#include "core/transport/certain_bounds.h"

#include <algorithm>
#include <cmath>

#include "core/base/normal_cone.h"
#include "core/base/photometry.h"
#include "core/transport/exposed_part.h"

namespace fluxwalk::transport {

namespace {

using hierarchy::Shape;

// Largest cosine between an element's normals and a direction.
double largestCosine(const Shape& shape, const Vec3d& direction) {
    const double between = base::NormalCone::angleBetween(glm::normalize(Vec3d(shape.axis)), direction);
    const double least = std::max(0.0, between - static_cast<double>(shape.halfAngle));
    return std::cos(std::min(base::kPi, least));
}

// Most that a light source without area, or the sky, sends to any point of an element.
double boundSource(const hierarchy::Hierarchy& h, const Shape& shape, NodeId source) {
    if (h.kind(source) == hierarchy::NodeKind::sky) {
        return 0.5 * (1.0 + largestCosine(shape, {0, 1, 0}));
    }
    const scene::Light& light = h.scene().lights[h.lightIndex(source)];
    if (light.kind == scene::LightKind::directional) {
        return std::max(0.0, largestCosine(shape, -glm::normalize(light.direction)));
    }
    const double nearest =
        glm::distance(Vec3d(shape.center), light.position) - static_cast<double>(shape.radius);
    return 1.0 / std::max(nearest > 0.0 ? nearest * nearest : 0.0, 1e-12);
}

}  // namespace

PairBounds boundPair(const hierarchy::Hierarchy& h, NodeId a, NodeId b) {
    PairBounds bounds;
    const Shape& shapeA = h.shape(a);
    if (h.kind(b) != hierarchy::NodeKind::element) {
        bounds.atA.upper = boundSource(h, shapeA, b);
        return bounds;
    }
    const Shape& shapeB = h.shape(b);
    const hierarchy::ElementName nameA = h.name(a);
    const hierarchy::ElementName nameB = h.name(b);
    const bool isSameSide = nameA.object == nameB.object && nameA.back == nameB.back;
    if (const auto kernel = isSameSide ? h.surfaceOf(a).exactKernel(nameA.back) : std::nullopt) {
        const double toA = *kernel * static_cast<double>(shapeB.area);
        const double toB = *kernel * static_cast<double>(shapeA.area);
        bounds = {{toA, toA}, {toB, toB}};
    } else {
        bounds = {boundPointFactor(h, a, makeSourceParts(h, b)),
                  boundPointFactor(h, b, makeSourceParts(h, a))};
    }
    if (isPartlyHidden(shapeB)) {
        bounds.atA.lower = 0.0;
    }
    if (isPartlyHidden(shapeA)) {
        bounds.atB.lower = 0.0;
    }
    return bounds;
}

}  // namespace fluxwalk::transport
