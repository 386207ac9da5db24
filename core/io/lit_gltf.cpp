#include "core/io/lit_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/io/file.h"
#include "core/io/glb_write.h"
#include "core/io/gltf_write_parts.h"
#include "core/io/lit_colors.h"
#include "core/scene/texture.h"

namespace fluxwalk::io {

namespace {

using base::Rgb;
using nlohmann::json;

class LitWriter {
  public:
    LitWriter(const scene::Scene& scene, const LitExport& settings)
        : scene_(scene), textures_(scene), settings_(settings) {}

    std::vector<std::uint8_t> write(const scene::LitMeshes& meshes) {
        json& root = glb_.root;
        root["asset"] = {
            {"version", "2.0"},
            {"generator", "Fluxwalk " FLUXWALK_VERSION},
            {"extras",
             {{"fluxwalk_lit", 1},
              {"fluxwalk_exposure", settings_.exposure},
              {"fluxwalk_sky", toJson(scene_.sky)},
              {"fluxwalk_units",
               "_IRRADIANCE: lux per channel, linear Rec.709; COLOR_0 = min(1, fluxwalk_exposure * exitance "
               "in lm/m2); metres"}}}};
        root["scene"] = 0;
        root["scenes"] = {{{"name", scene_.name}, {"nodes", json::array()}}};
        root["extensionsUsed"] = {"KHR_materials_unlit"};
        for (const scene::Material& material : scene_.materials) {
            glb_.append("materials", materialJson(material));
        }
        writeMeshes(meshes);
        for (const scene::Camera& camera : scene_.cameras) {
            addNode(cameraNode(glb_, camera));
        }
        return glb_.pack();
    }

  private:
    json materialJson(const scene::Material& material) {
        json m = {{"name", material.name},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {1.0, 1.0, 1.0, material.alpha}},
                    {"metallicFactor", 0.0},
                    {"roughnessFactor", 1.0}}},
                  {"extensions", {{"KHR_materials_unlit", json::object()}}}};
        Rgb reflectance = material.reflectance;
        if (material.reflectanceTexture.isSet()) {
            if (material.isEmissive()) {
                // The vertex colours carry it: only its mean remains for whoever reads the file back.
                reflectance *= Rgb(textures_.sample(material.reflectanceTexture, base::Vec2d(0.5), 32.0f));
            } else {
                m["pbrMetallicRoughness"]["baseColorTexture"] =
                    textureWriter_.info(material.reflectanceTexture);
            }
        }
        m["extras"] = {{"fluxwalk_reflectance", toJson(reflectance)},
                       {"fluxwalk_emission", toJson(material.emission)},
                       {"fluxwalk_double_sided", material.doubleSided}};
        addAlphaAndEmission(glb_, textureWriter_, material, m);
        return m;
    }

    void writeMeshes(const scene::LitMeshes& meshes) {
        // In the order of the objects' first meshes, both sides of an object together.
        std::vector<std::uint32_t> order;
        std::map<std::uint32_t, json> primitivesOf;
        for (const auto& mesh : meshes) {
            if (mesh->triangles.empty()) {
                continue;
            }
            json& primitives = primitivesOf[mesh->object];
            if (primitives.empty()) {
                order.push_back(mesh->object);
            }
            primitives.push_back(primitiveJson(*mesh));
        }
        for (const std::uint32_t object : order) {
            const std::string& name = scene_.objects[object].name;
            const std::size_t mesh =
                glb_.append("meshes", {{"name", name}, {"primitives", primitivesOf[object]}});
            addNode({{"name", name}, {"mesh", mesh}});
        }
    }

    json primitiveJson(const scene::LitMesh& mesh) {
        const std::size_t count = mesh.positions.size();
        FLUXWALK_CHECK_EQ(mesh.normals.size(), count);
        FLUXWALK_CHECK_EQ(mesh.irradiance.size(), count);
        const scene::Material& material = scene_.materials[mesh.material];
        std::vector<Rgb> colors = vertexExitance(scene_, textures_, mesh, material.isEmissive());
        for (Rgb& c : colors) {
            c = glm::clamp(settings_.exposure * c, Rgb(0.0f), Rgb(1.0f));
        }
        json attributes = {{"POSITION", glb_.addVectors(mesh.positions, true)},
                           {"NORMAL", glb_.addVectors(mesh.normals)},
                           {"COLOR_0", glb_.addVectors(colors)},
                           {"_IRRADIANCE", glb_.addVectors(mesh.irradiance)}};
        // A second set may not stand alone.
        const bool hasSecond = !mesh.texcoords[1].empty();
        const std::vector<base::Vec2> zeros(hasSecond && mesh.texcoords[0].empty() ? count : 0);
        for (std::size_t set = 0; set < 2; ++set) {
            const std::vector<base::Vec2>& texcoords =
                set == 0 && !zeros.empty() ? zeros : mesh.texcoords[set];
            if (!texcoords.empty()) {
                FLUXWALK_CHECK_EQ(texcoords.size(), count);
                attributes["TEXCOORD_" + std::to_string(set)] = glb_.addVectors(texcoords);
            }
        }
        return {{"attributes", attributes},
                {"indices", glb_.addIndices(mesh.triangles)},
                {"material", mesh.material},
                {"extras", {{"fluxwalk_back", mesh.back}}}};
    }

    void addNode(json node) {
        const std::size_t index = glb_.append("nodes", std::move(node));
        glb_.root["scenes"][0]["nodes"].push_back(index);
    }

    const scene::Scene& scene_;
    scene::TextureSet textures_;
    LitExport settings_;
    GlbBuilder glb_;
    TextureWriter textureWriter_{glb_, scene_};
};

}  // namespace

void writeLitGltf(const std::filesystem::path& file, const scene::Scene& scene,
                  const scene::LitMeshes& meshes, const LitExport& settings) {
    const std::vector<std::uint8_t> bytes = LitWriter(scene, settings).write(meshes);
    if (bytes.empty()) {
        throw base::FileError(file.string(), "", "cannot be written: the lit mesh exceeds the 4 GiB of .glb");
    }
    writeFile(file, bytes);
}

}  // namespace fluxwalk::io
