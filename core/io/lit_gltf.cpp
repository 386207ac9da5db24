#include "core/io/lit_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/io/file.h"
#include "core/io/glb_write.h"
#include "core/io/image_write.h"
#include "core/io/lit_colors.h"
#include "core/scene/texture.h"

namespace fluxwalk::io {

namespace {

using base::Rgb;
using nlohmann::json;

json toJson(const Rgb& c) {
    return {c.r, c.g, c.b};
}

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
            writeCamera(camera);
        }
        return glb_.pack();
    }

  private:
    void useExtension(const char* name) {
        json& used = glb_.root["extensionsUsed"];
        if (std::find(used.begin(), used.end(), name) == used.end()) {
            used.push_back(name);
        }
    }

    std::size_t imageIndex(std::int32_t image) {
        const auto [entry, isNew] = imageIndex_.try_emplace(image, 0);
        if (isNew) {
            const scene::Image& picture = scene_.images[static_cast<std::size_t>(image)];
            const std::size_t view = glb_.addView(encodePng(picture.width, picture.height, 4, picture.rgba));
            entry->second = glb_.append(
                "images", {{"name", picture.name}, {"mimeType", "image/png"}, {"bufferView", view}});
        }
        return entry->second;
    }

    json textureInfo(const scene::TextureRef& texture) {
        const auto wrapMode = [](scene::Wrap wrap) {
            return wrap == scene::Wrap::repeat ? 10497 : (wrap == scene::Wrap::mirror ? 33648 : 33071);
        };
        const std::size_t sampler =
            glb_.append("samplers", {{"wrapS", wrapMode(texture.wrapU)}, {"wrapT", wrapMode(texture.wrapV)}});
        const std::size_t index =
            glb_.append("textures", {{"source", imageIndex(texture.image)}, {"sampler", sampler}});
        json info = {{"index", index}, {"texCoord", texture.texcoordSet}};
        const scene::TextureRef plain;
        if (texture.offset != plain.offset || texture.scale != plain.scale ||
            texture.rotation != plain.rotation) {
            useExtension("KHR_texture_transform");
            info["extensions"]["KHR_texture_transform"] = {{"offset", {texture.offset.x, texture.offset.y}},
                                                           {"scale", {texture.scale.x, texture.scale.y}},
                                                           {"rotation", texture.rotation}};
        }
        return info;
    }

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
                m["pbrMetallicRoughness"]["baseColorTexture"] = textureInfo(material.reflectanceTexture);
            }
        }
        if (material.alphaMode == scene::AlphaMode::mask) {
            m["alphaMode"] = "MASK";
            m["alphaCutoff"] = material.alphaCutoff;
        } else if (material.alphaMode == scene::AlphaMode::blend) {
            m["alphaMode"] = "BLEND";
        }
        m["extras"] = {{"fluxwalk_reflectance", toJson(reflectance)},
                       {"fluxwalk_emission", toJson(material.emission)},
                       {"fluxwalk_double_sided", material.doubleSided}};
        if (material.isEmissive()) {
            const float most = std::max({material.emission.r, material.emission.g, material.emission.b});
            useExtension("KHR_materials_emissive_strength");
            m["emissiveFactor"] = toJson(material.emission / most);
            m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
                static_cast<double>(most) / base::kPi;
            if (material.emissionTexture.isSet()) {
                m["emissiveTexture"] = textureInfo(material.emissionTexture);
            }
        }
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

    void writeCamera(const scene::Camera& camera) {
        const std::size_t index = glb_.append(
            "cameras", {{"name", camera.name},
                        {"type", "perspective"},
                        {"perspective", {{"yfov", camera.verticalFov}, {"znear", camera.nearPlane}}}});
        const base::Vec3d back = -glm::normalize(camera.forward);
        const base::Vec3d right = glm::normalize(glm::cross(camera.up, back));
        const base::Vec3d up = glm::cross(back, right);
        const base::Vec3d& p = camera.position;
        addNode({{"name", camera.name},
                 {"camera", index},
                 {"matrix",
                  {right.x, right.y, right.z, 0.0, up.x, up.y, up.z, 0.0, back.x, back.y, back.z, 0.0, p.x,
                   p.y, p.z, 1.0}}});
    }

    const scene::Scene& scene_;
    scene::TextureSet textures_;
    LitExport settings_;
    GlbBuilder glb_;
    std::map<std::int32_t, std::size_t> imageIndex_;
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
