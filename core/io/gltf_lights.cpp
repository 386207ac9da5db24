#include "core/io/gltf_lights.h"

#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::io {

namespace {

using base::Vec3d;

constexpr double kMaxIntensity = 1e13;

bool isFinite(const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Direction of a local axis in the world; the scale of the node plays no part.
Vec3d axisOf(GltfModel& model, const PlacedNode& node, const Vec3d& axis) {
    const Vec3d world(node.worldFromNode * glm::dvec4(axis, 0.0));
    const double length = glm::length(world);
    if (!(length > 0.0) || !std::isfinite(length)) {
        model.fail(node.place, "the transform leaves its light or camera no direction");
    }
    return world / length;
}

Vec3d positionOf(const GltfModel& model, const PlacedNode& node) {
    const Vec3d position(node.worldFromNode[3]);
    if (!isFinite(position)) {
        model.fail(node.place, "its position is not finite");
    }
    return position;
}

void readCone(GltfModel& model, const PlacedNode& node, const tinygltf::SpotLight& spot,
              scene::Light& light) {
    constexpr double kWidest = 0.5 * base::kPi;
    light.outerConeAngle = std::clamp(spot.outerConeAngle, 1e-4, kWidest);
    light.innerConeAngle = std::clamp(spot.innerConeAngle, 0.0, light.outerConeAngle);
    if (light.outerConeAngle != spot.outerConeAngle || light.innerConeAngle != spot.innerConeAngle) {
        model.warnings.add("the spot's cone angles are not 0 <= inner <= outer <= pi/2; clamped", node.place);
    }
}

}  // namespace

void readLight(GltfModel& model, const PlacedNode& node, scene::Scene& scene) {
    const tinygltf::Node& source = model.data.nodes[static_cast<std::size_t>(node.index)];
    const tinygltf::Value* extension = findExtension(source.extensions, "KHR_lights_punctual");
    if (extension == nullptr) {
        return;
    }
    const int index = findIndex(*extension, "light").value_or(-1);
    const tinygltf::Light& from =
        model.at(model.data.lights, index, node.place + "/extensions/KHR_lights_punctual/light");
    scene::Light light;
    light.name = nameOf(model, node, from.name);
    if (from.type == "spot") {
        light.kind = scene::LightKind::spot;
        readCone(model, node, from.spot, light);
    } else if (from.type == "directional") {
        light.kind = scene::LightKind::directional;
    } else if (from.type != "point") {
        model.warnings.add("a light of type '" + from.type + "' is not known; left out", node.place);
        return;
    }
    for (int c = 0; c < 3; ++c) {
        const double color = from.color.size() == 3 ? from.color[static_cast<std::size_t>(c)] : 1.0;
        const double intensity = color * from.intensity;
        if (!(intensity >= 0.0 && intensity <= kMaxIntensity)) {
            model.fail(node.place, "the light's intensity is negative or too large");
        }
        light.intensity[c] = static_cast<float>(intensity);
    }
    light.position = positionOf(model, node);
    light.direction = axisOf(model, node, Vec3d(0.0, 0.0, -1.0));
    if (from.range > 0.0) {
        light.range = from.range;
        model.warnings.add("the light's range cuts its light off, which is not physical", node.place);
    }
    scene.lights.push_back(std::move(light));
}

void readCamera(GltfModel& model, const PlacedNode& node, scene::Scene& scene) {
    const tinygltf::Node& source = model.data.nodes[static_cast<std::size_t>(node.index)];
    if (source.camera < 0) {
        return;
    }
    const tinygltf::Camera& from = model.at(model.data.cameras, source.camera, node.place);
    if (from.type != "perspective") {
        model.warnings.add("a camera that is not perspective is not supported; left out", node.place);
        return;
    }
    const double fov = from.perspective.yfov;
    if (!(fov > 0.0 && fov < base::kPi)) {
        model.warnings.add("the camera's field of view is not between 0 and pi; left out", node.place);
        return;
    }
    scene::Camera camera;
    camera.name = nameOf(model, node, from.name);
    camera.position = positionOf(model, node);
    camera.forward = axisOf(model, node, Vec3d(0.0, 0.0, -1.0));
    const Vec3d up = axisOf(model, node, Vec3d(0.0, 1.0, 0.0));
    const Vec3d across = up - glm::dot(up, camera.forward) * camera.forward;
    if (!(glm::length(across) > 1e-9)) {
        model.fail(node.place, "the transform leaves its camera no upward direction");
    }
    camera.up = glm::normalize(across);
    camera.verticalFov = fov;
    if (from.perspective.znear > 0.0 && from.perspective.znear < 1e9) {
        camera.nearPlane = from.perspective.znear;
    }
    scene.cameras.push_back(std::move(camera));
}

}  // namespace fluxwalk::io
