#include "core/io/gltf_read.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/io/gltf_cage.h"
#include "core/io/gltf_exact.h"
#include "core/io/gltf_lights.h"
#include "core/io/gltf_materials.h"
#include "core/io/gltf_meshes.h"
#include "core/io/gltf_model.h"
#include "core/io/gltf_nodes.h"

namespace fluxwalk::io {

namespace {

/// Extensions that are read, or whose absence of effect is named where they are used.
constexpr std::array<std::string_view, 7> kKnownExtensions{
    "FB_ngon_encoding",           "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_materials_transmission", "KHR_materials_unlit", "KHR_mesh_quantization",
    "KHR_texture_transform"};

/// Builds the objects of a scene, one for each primitive that a node uses.
class ObjectBuilder {
  public:
    ObjectBuilder(GltfModel& model, scene::Scene& scene)
        : model_(model), scene_(scene), fileMaterials_(scene.materials.size()) {}

    void addNode(const PlacedNode& node) {
        const tinygltf::Node& source = model_.data.nodes[static_cast<std::size_t>(node.index)];
        if (source.skin >= 0) {
            model_.warnings.add("skins are not supported; the mesh is used as it is stored", node.place);
        }
        if (source.mesh < 0) {
            return;
        }
        const tinygltf::Mesh& mesh = model_.at(model_.data.meshes, source.mesh, node.place);
        const std::string name = nameOf(model_, node, mesh.name);
        if (!mesh.primitives.empty() && isControlCage(model_, node) && addSubdivision(node, mesh, name)) {
            return;
        }
        if (!mesh.primitives.empty() && hasExactSurface(model_, node)) {
            nameOneMaterial(mesh, node);
            if (auto surface = readExactSurface(model_, node)) {
                add(name, std::move(surface), materialOf(mesh.primitives[0], node));
            }
            return;
        }
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const std::uint32_t material = materialOf(mesh.primitives[i], node);
            auto soup =
                readPrimitive(model_, node, static_cast<int>(i), scene_.materials[material], trianglesLeft_);
            if (!soup) {
                continue;
            }
            auto surface = std::make_shared<surface::PolygonMesh>(std::move(*soup));
            scene_.droppedTriangleCount += surface->droppedTriangleCount();
            if (surface->patchCount() > 0) {
                add(mesh.primitives.size() > 1 ? name + "/" + std::to_string(i) : name, std::move(surface),
                    material);
            }
        }
    }

  private:
    void nameOneMaterial(const tinygltf::Mesh& mesh, const PlacedNode& node) {
        if (mesh.primitives.size() > 1) {
            model_.warnings.add("an exact surface has one material, that of the first primitive", node.place);
        }
    }

    // False where the mesh is no control cage.
    bool addSubdivision(const PlacedNode& node, const tinygltf::Mesh& mesh, const std::string& name) {
        const std::uint64_t before = trianglesLeft_;
        const std::uint32_t material = materialOf(mesh.primitives[0], node);
        auto surface = readSubdivision(model_, node, scene_.materials[material], trianglesLeft_);
        if (surface == nullptr) {
            trianglesLeft_ = before;
            return false;
        }
        nameOneMaterial(mesh, node);
        add(name, std::move(surface), material);
        return true;
    }

    void add(const std::string& name, std::shared_ptr<const surface::Surface> surface,
             std::uint32_t material) {
        // Names are keys elsewhere: each is used once.
        std::string unique = name;
        for (std::size_t& last = lastNumber_[name]; !names_.insert(unique).second;) {
            last = std::max<std::size_t>(2, last + 1);
            unique = name + "#" + std::to_string(last);
        }
        scene_.objects.push_back({unique, std::move(surface), material});
    }

    std::uint32_t materialOf(const tinygltf::Primitive& primitive, const PlacedNode& node) {
        if (primitive.material >= 0) {
            return static_cast<std::uint32_t>(primitive.material);
        }
        if (scene_.materials.size() == fileMaterials_) {
            scene_.materials.emplace_back().name = "no material";
        }
        model_.warnings.add("a primitive has no material; it reflects half of the light", node.place);
        return static_cast<std::uint32_t>(fileMaterials_);
    }

    GltfModel& model_;
    scene::Scene& scene_;
    std::size_t fileMaterials_;
    std::set<std::string> names_;
    /// The last number appended to a name that is used more than once.
    std::map<std::string, std::size_t> lastNumber_;
    std::uint64_t trianglesLeft_ = kMaxTriangles;
};

void nameUnsupported(GltfModel& model) {
    for (const std::string& extension : model.data.extensionsUsed) {
        if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension) ==
            kKnownExtensions.end()) {
            model.warnings.add(extension + " is not supported and ignored", "/extensionsUsed");
        }
    }
    if (!model.data.animations.empty()) {
        model.warnings.add("animations are ignored", "/animations");
    }
}

}  // namespace

scene::Scene readGltf(const std::filesystem::path& file) {
    GltfModel model = loadGltf(file);
    scene::Scene scene;
    scene.name = file.stem().string();
    nameUnsupported(model);
    readMaterials(model, scene);
    ObjectBuilder objects(model, scene);
    for (const PlacedNode& node : placeNodes(model)) {
        objects.addNode(node);
        readLight(model, node, scene);
        readCamera(model, node, scene);
    }
    if (scene.objects.empty()) {
        model.fail("", "the scene has no surface: no triangle with an area");
    }
    scene.warnings = model.warnings.lines();
    if (scene.droppedTriangleCount > 0) {
        scene.warnings.push_back(std::to_string(scene.droppedTriangleCount) +
                                 " triangles without area were dropped");
    }
    return scene;
}

}  // namespace fluxwalk::io
