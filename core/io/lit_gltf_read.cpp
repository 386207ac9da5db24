#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/gltf_accessors.h"
#include "core/io/gltf_container.h"
#include "core/io/gltf_lights.h"
#include "core/io/gltf_materials.h"
#include "core/io/gltf_meshes.h"
#include "core/io/gltf_model.h"
#include "core/io/gltf_nodes.h"
#include "core/io/lit_gltf.h"
#include "core/surface/polygon_mesh.h"

namespace fluxwalk::io {

namespace {

using base::Rgb;

std::optional<Rgb> findColor(const tinygltf::Value& extras, const std::string& key) {
    const std::vector<double> numbers = findNumbers(extras, key, 3);
    if (numbers.empty()) {
        return std::nullopt;
    }
    Rgb color;
    for (int c = 0; c < 3; ++c) {
        color[c] = std::max(0.0f, toFloat(numbers[static_cast<std::size_t>(c)]));
    }
    return color;
}

// The glTF materials show the light; their extras keep what it came from.
void restoreMaterials(const GltfModel& model, scene::Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const tinygltf::Value& extras = model.data.materials[i].extras;
        scene::Material& material = scene.materials[i];
        if (const auto reflectance = findColor(extras, "fluxwalk_reflectance")) {
            material.reflectance = glm::min(*reflectance, Rgb(1.0f));
        }
        if (const auto emission = findColor(extras, "fluxwalk_emission")) {
            material.emission = *emission;
        }
        material.doubleSided = findBool(extras, "fluxwalk_double_sided").value_or(false);
    }
}

/// Reads the vertex attributes of one primitive.
class PrimitiveReader {
  public:
    PrimitiveReader(const GltfModel& model, const tinygltf::Primitive& primitive, std::string place)
        : model_(model), primitive_(primitive), place_(std::move(place)) {}

    std::shared_ptr<const scene::LitMesh> read(std::uint32_t object) {
        auto mesh = std::make_shared<scene::LitMesh>();
        mesh->object = object;
        if (primitive_.material < 0 || primitive_.mode != TINYGLTF_MODE_TRIANGLES) {
            model_.fail(place_, "a lit mesh must have a material and consist of triangles");
        }
        mesh->material = static_cast<std::uint32_t>(primitive_.material);
        mesh->back = findBool(primitive_.extras, "fluxwalk_back").value_or(false);
        mesh->positions = vectors<base::Vec3>("POSITION", true);
        count_ = mesh->positions.size();
        mesh->normals = vectors<base::Vec3>("NORMAL", true);
        mesh->irradiance = vectors<Rgb>("_IRRADIANCE", true);
        mesh->texcoords[0] = vectors<base::Vec2>("TEXCOORD_0", false);
        mesh->texcoords[1] = vectors<base::Vec2>("TEXCOORD_1", false);
        mesh->triangles = readCorners(model_, primitive_, count_);
        if (mesh->triangles.size() % 3 != 0) {
            model_.fail(place_, std::to_string(mesh->triangles.size()) + " corners do not make triangles");
        }
        return mesh;
    }

  private:
    template <class Vector>
    std::vector<Vector> vectors(const char* attribute, bool required) const {
        const auto found = primitive_.attributes.find(attribute);
        if (found == primitive_.attributes.end()) {
            if (required) {
                model_.fail(place_, std::string("has no ") + attribute);
            }
            return {};
        }
        const AccessorReader reader(model_, found->second);
        const auto width = static_cast<unsigned>(Vector::length());
        if (reader.components() != width || (count_ != 0 && reader.size() != count_)) {
            model_.fail(reader.place(), std::string(attribute) + " has the wrong type or count");
        }
        std::vector<Vector> result(reader.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            for (unsigned c = 0; c < width; ++c) {
                const double value = reader.component(i, c);
                if (!std::isfinite(value)) {
                    model_.fail(reader.place(), "element " + std::to_string(i) + " is not finite");
                }
                result[i][static_cast<int>(c)] = static_cast<float>(value);
            }
        }
        return result;
    }

    const GltfModel& model_;
    const tinygltf::Primitive& primitive_;
    std::string place_;
    std::size_t count_ = 0;
};

// The displayed triangles of one side as a surface, to walk on and to shoot rays at.
std::shared_ptr<const surface::Surface> surfaceOf(const scene::LitMesh& mesh) {
    surface::TriangleSoup soup;
    soup.positions = mesh.positions;
    soup.texcoords = mesh.texcoords;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const std::uint32_t* t = mesh.triangles.data() + i;
        soup.triangles.push_back({t[0], t[mesh.back ? 2 : 1], t[mesh.back ? 1 : 2]});
    }
    return std::make_shared<surface::PolygonMesh>(std::move(soup));
}

void readObject(const GltfModel& model, const PlacedNode& node, LitFile& result) {
    const int mesh = model.data.nodes[static_cast<std::size_t>(node.index)].mesh;
    if (mesh < 0) {
        return;
    }
    const auto object = static_cast<std::uint32_t>(result.scene.objects.size());
    const tinygltf::Mesh& from = model.at(model.data.meshes, mesh, node.place);
    const scene::LitMesh* shape = nullptr;
    for (std::size_t i = 0; i < from.primitives.size(); ++i) {
        const std::string place = "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(i);
        result.meshes.push_back(PrimitiveReader(model, from.primitives[i], place).read(object));
        const scene::LitMesh& read = *result.meshes.back();
        if (shape == nullptr || (shape->back && !read.back)) {
            shape = &read;
        }
    }
    if (shape != nullptr) {
        result.scene.objects.push_back({nameOf(model, node, from.name), surfaceOf(*shape), shape->material});
    }
}

}  // namespace

bool isLitGltf(const std::filesystem::path& file) {
    try {
        const GltfContainer container = openGltf(file);
        const nlohmann::json root = nlohmann::json::parse(container.json, nullptr, false);
        const nlohmann::json::json_pointer mark("/asset/extras/fluxwalk_lit");
        return root.is_object() && root.contains(mark);
    } catch (const base::FileError&) {
        return false;
    }
}

LitFile readLitGltf(const std::filesystem::path& file) {
    GltfModel model = loadGltf(file);
    const tinygltf::Value& extras = model.data.asset.extras;
    if (!extras.Has("fluxwalk_lit")) {
        model.fail("/asset/extras", "this is not a lit mesh written by fluxwalk");
    }
    LitFile result;
    result.scene.name = file.stem().string();
    result.settings.exposure = toFloat(findNumber(extras, "fluxwalk_exposure").value_or(1.0));
    result.scene.sky = findColor(extras, "fluxwalk_sky").value_or(Rgb(0.0f));
    readMaterials(model, result.scene);
    restoreMaterials(model, result.scene);
    for (const PlacedNode& node : placeNodes(model)) {
        readObject(model, node, result);
        readCamera(model, node, result.scene);
    }
    if (result.meshes.empty()) {
        model.fail("", "the lit mesh is empty");
    }
    return result;
}

}  // namespace fluxwalk::io
