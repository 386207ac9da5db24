#include "core/io/gltf_exact.h"

#include <cmath>

#include "core/io/gltf_meshes.h"
#include "core/surface/sphere.h"

namespace fluxwalk::io {

namespace {

/// Largest and smallest radius and scale that leave floats their digits.
constexpr double kLargest = 1e9;
constexpr double kSmallest = 1e-9;
/// A stand-in may be centred this far off, relative to its radius: tessellations are not quite symmetric.
constexpr double kOffCentre = 0.05;

const tinygltf::Value& extrasOf(const GltfModel& model, const PlacedNode& node) {
    return model.data.nodes[static_cast<std::size_t>(node.index)].extras;
}

bool isUsable(const base::Mat4d& m) {
    for (int column = 0; column < 4; ++column) {
        const double length = glm::length(base::Vec3d(m[column]));
        if (!(length <= kLargest) || (column < 3 && !(length >= kSmallest))) {
            return false;
        }
    }
    // Flat: the axes span no volume compared to their lengths.
    const double volume = std::abs(glm::determinant(glm::dmat3(m)));
    return volume > 1e-9 * glm::length(base::Vec3d(m[0])) * glm::length(base::Vec3d(m[1])) *
                        glm::length(base::Vec3d(m[2]));
}

}  // namespace

bool hasExactSurface(GltfModel& model, const PlacedNode& node) {
    const tinygltf::Value& extras = extrasOf(model, node);
    if (!extras.Has("fluxwalk_surface")) {
        return false;
    }
    const std::string kind = findString(extras, "fluxwalk_surface");
    if (kind == "sphere") {
        return true;
    }
    model.warnings.add("fluxwalk_surface '" + kind + "' is not supported; the stand-in mesh is used",
                       node.place);
    return false;
}

std::shared_ptr<const surface::Surface> readExactSurface(GltfModel& model, const PlacedNode& node) {
    const tinygltf::Value& extras = extrasOf(model, node);
    const base::Box standIn = localBounds(model, node, 0);
    const base::Vec3d half = 0.5 * standIn.size();
    double radius = findNumber(extras, "fluxwalk_radius").value_or(0.0);
    if (extras.Has("fluxwalk_radius") && !(radius > 0.0)) {
        model.warnings.add("fluxwalk_radius is not a positive number; the stand-in's size is used",
                           node.place);
    }
    if (!(radius > 0.0)) {
        radius = std::max({half.x, half.y, half.z});
    }
    if (glm::length(standIn.center()) > kOffCentre * radius) {
        model.warnings.add("the stand-in mesh is not centred on its node; the sphere is", node.place);
    }
    base::Mat4d worldFromUnit = node.worldFromNode;
    for (int column = 0; column < 3; ++column) {
        worldFromUnit[column] *= radius;
    }
    if (!isUsable(worldFromUnit)) {
        model.warnings.add("the sphere's size or transform leaves it no area; left out", node.place);
        return nullptr;
    }
    return std::make_shared<surface::Sphere>(worldFromUnit,
                                             findBool(extras, "fluxwalk_inside").value_or(false));
}

}  // namespace fluxwalk::io
