#include "core/io/exact_extras.h"

#include <cmath>

#include "core/surface/cone.h"
#include "core/surface/disk.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"

namespace fluxwalk::io {

namespace {

using base::Vec3d;

/// The lengths of a map's axes, where these are at right angles.
struct Sizes {
    double across = 1.0;
    double along = 1.0;
};

base::Mat4d matrixOf(const surface::AffineMap& map) {
    base::Mat4d m(map.linear);
    m[3] = glm::dvec4(map.center, 1.0);
    return m;
}

// Takes the lengths out of a map that scales its axes x and z alike (and y too if `isUniform`); leaves other
// maps as they are, with lengths of 1.
Sizes takeSizes(base::Mat4d& m, bool isUniform) {
    const Vec3d x(m[0]);
    const Vec3d y(m[1]);
    const Vec3d z(m[2]);
    const Sizes sizes{glm::length(x), glm::length(y)};
    constexpr double kEqual = 1e-12;
    const double skew = std::abs(glm::dot(x, y)) + std::abs(glm::dot(y, z)) + std::abs(glm::dot(z, x));
    const bool isRound = std::abs(glm::length(z) - sizes.across) <= kEqual * sizes.across &&
                         skew <= kEqual * sizes.across * std::max(sizes.across, sizes.along);
    if (!isRound || (isUniform && std::abs(sizes.along - sizes.across) > kEqual * sizes.across)) {
        return {};
    }
    m[0] /= sizes.across;
    m[1] /= sizes.along;
    m[2] /= sizes.across;
    return sizes;
}

}  // namespace

std::optional<ExactNode> describeExactNode(const surface::Surface& surface) {
    ExactNode node;
    node.extras["fluxwalk_surface"] = surface.kind();
    bool isInside = false;
    if (const auto* sphere = dynamic_cast<const surface::Sphere*>(&surface)) {
        node.worldFromNode = sphere->worldFromUnit();
        node.extras["fluxwalk_radius"] = takeSizes(node.worldFromNode, true).across;
        isInside = sphere->isInside();
    } else if (const auto* torus = dynamic_cast<const surface::Torus*>(&surface)) {
        node.worldFromNode = matrixOf(torus->map());
        const double radius = takeSizes(node.worldFromNode, true).across;
        node.extras["fluxwalk_major_radius"] = radius;
        node.extras["fluxwalk_minor_radius"] = torus->tube() * radius;
        isInside = torus->isInside();
    } else if (const auto* turned = dynamic_cast<const surface::RevolvedSegment*>(&surface)) {
        const bool isDisk = dynamic_cast<const surface::Disk*>(&surface) != nullptr;
        node.worldFromNode = matrixOf(turned->map());
        const Sizes sizes = takeSizes(node.worldFromNode, isDisk);
        if (isDisk) {
            node.extras["fluxwalk_radius"] = sizes.across;
            node.extras["fluxwalk_inner_radius"] = turned->last().radius * sizes.across;
        } else if (surface.kind() == "cylinder") {
            node.extras["fluxwalk_radius"] = sizes.across;
            node.extras["fluxwalk_height"] = sizes.along;
        } else {
            node.extras["fluxwalk_radius_bottom"] = turned->first().radius * sizes.across;
            node.extras["fluxwalk_radius_top"] = turned->last().radius * sizes.across;
            node.extras["fluxwalk_height"] = sizes.along;
        }
        isInside = turned->isInside();
    } else {
        return std::nullopt;
    }
    if (isInside) {
        node.extras["fluxwalk_inside"] = true;
    }
    return node;
}

}  // namespace fluxwalk::io
