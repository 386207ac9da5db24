#include "core/io/gltf_cage.h"

#include <algorithm>
#include <cmath>

#include "core/io/cage_faces.h"
#include "core/io/gltf_meshes.h"
#include "core/surface/subdivision_surface.h"

namespace fluxwalk::io {

namespace {

constexpr const char* kScheme = "fluxwalk_subdivision";
constexpr const char* kCreaseAngle = "fluxwalk_crease_angle";

const tinygltf::Node& nodeOf(const GltfModel& model, const PlacedNode& node) {
    return model.data.nodes[static_cast<std::size_t>(node.index)];
}

void readCreases(GltfModel& model, const PlacedNode& node, surface::ControlCage& cage) {
    const tinygltf::Value& extras = nodeOf(model, node).extras;
    if (!extras.Has(kCreaseAngle)) {
        return;
    }
    const std::optional<double> degrees = findNumber(extras, kCreaseAngle);
    if (!degrees || !(*degrees >= 0.0 && *degrees <= 180.0)) {
        model.warnings.add(std::string(kCreaseAngle) + " is no angle from 0 to 180 degrees; no edge is sharp",
                           node.place);
        return;
    }
    sharpenEdges(cage, *degrees);
}

// False where the axes span no volume compared to their lengths: vertices would fall together.
bool spansSpace(const base::Mat4d& m) {
    const glm::dmat3 linear(m);
    const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    return std::abs(glm::determinant(linear)) > 1e-9 * lengths;
}

}  // namespace

bool isControlCage(GltfModel& model, const PlacedNode& node) {
    const tinygltf::Value& extras = nodeOf(model, node).extras;
    if (!extras.Has(kScheme)) {
        return false;
    }
    if (extras.Has("fluxwalk_surface")) {
        model.warnings.add("the node has both fluxwalk_surface and fluxwalk_subdivision; the former counts",
                           node.place);
        return false;
    }
    if (!spansSpace(node.worldFromNode)) {
        model.warnings.add("the node's transform leaves a control cage no volume; the control mesh is used",
                           node.place);
        return false;
    }
    const std::string scheme = findString(extras, kScheme);
    if (scheme != "catmullClark" && scheme != "loop") {
        model.warnings.add("fluxwalk_subdivision '" + scheme + "' is not known; the control mesh is used",
                           node.place);
        return false;
    }
    return true;
}

std::shared_ptr<const surface::Surface> readSubdivision(GltfModel& model, const PlacedNode& node,
                                                        const scene::Material& material,
                                                        std::uint64_t& trianglesLeft) {
    const tinygltf::Node& source = nodeOf(model, node);
    const tinygltf::Mesh& mesh = model.at(model.data.meshes, source.mesh, node.place);
    std::vector<CageTriangles> parts;
    bool areAllFans = true;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        auto soup = readPrimitive(model, node, static_cast<int>(i), material, trianglesLeft);
        if (soup) {
            const bool areFans = mesh.primitives[i].extensions.count("FB_ngon_encoding") != 0;
            areAllFans = areAllFans && areFans;
            parts.push_back({std::move(*soup), areFans});
        }
    }
    const bool isLoop = findString(source.extras, kScheme) == "loop";
    surface::ControlCage cage = assembleCage(
        parts, isLoop ? surface::SubdivisionScheme::loop : surface::SubdivisionScheme::catmullClark);
    if (cage.faceSizes.size() > kMaxCageFaces) {
        model.warnings.add("the control cage has more than " + std::to_string(kMaxCageFaces) +
                               " faces; the control mesh is used",
                           node.place);
        return nullptr;
    }
    readCreases(model, node, cage);
    if (const auto defect = surface::findDefect(cage)) {
        model.warnings.add("no control cage: " + *defect + "; the control mesh is used", node.place);
        return nullptr;
    }
    const auto triangles = std::count(cage.faceSizes.begin(), cage.faceSizes.end(), 3u);
    if (!isLoop && !areAllFans && triangles > 0) {
        model.warnings.add(std::to_string(triangles) +
                               " triangles of the control cage make no planar quads and stay triangles "
                               "(FB_ngon_encoding keeps polygons)",
                           node.place);
    }
    return std::make_shared<surface::SubdivisionSurface>(cage);
}

}  // namespace fluxwalk::io
