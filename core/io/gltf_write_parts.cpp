#include "core/io/gltf_write_parts.h"

#include <algorithm>

#include "core/base/photometry.h"
#include "core/io/image_write.h"

namespace fluxwalk::io {

using nlohmann::json;

json toJson(const base::Rgb& c) {
    return {c.r, c.g, c.b};
}

void useExtension(GlbBuilder& glb, const char* name) {
    json& used = glb.root["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) {
        used.push_back(name);
    }
}

json cameraNode(GlbBuilder& glb, const scene::Camera& camera) {
    const std::size_t index =
        glb.append("cameras", {{"name", camera.name},
                               {"type", "perspective"},
                               {"perspective", {{"yfov", camera.verticalFov}, {"znear", camera.nearPlane}}}});
    const base::Vec3d back = -glm::normalize(camera.forward);
    const base::Vec3d right = glm::normalize(glm::cross(camera.up, back));
    const base::Vec3d up = glm::cross(back, right);
    const base::Vec3d& p = camera.position;
    return {{"name", camera.name},
            {"camera", index},
            {"matrix",
             {right.x, right.y, right.z, 0.0, up.x, up.y, up.z, 0.0, back.x, back.y, back.z, 0.0, p.x, p.y,
              p.z, 1.0}}};
}

json TextureWriter::info(const scene::TextureRef& texture) {
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
        useExtension(glb_, "KHR_texture_transform");
        info["extensions"]["KHR_texture_transform"] = {{"offset", {texture.offset.x, texture.offset.y}},
                                                       {"scale", {texture.scale.x, texture.scale.y}},
                                                       {"rotation", texture.rotation}};
    }
    return info;
}

std::size_t TextureWriter::imageIndex(std::int32_t image) {
    const auto [entry, isNew] = imageIndex_.try_emplace(image, 0);
    if (isNew) {
        const scene::Image& picture = scene_.images[static_cast<std::size_t>(image)];
        const std::size_t view = glb_.addView(encodePng(picture.width, picture.height, 4, picture.rgba));
        entry->second =
            glb_.append("images", {{"name", picture.name}, {"mimeType", "image/png"}, {"bufferView", view}});
    }
    return entry->second;
}

void addAlphaAndEmission(GlbBuilder& glb, TextureWriter& textures, const scene::Material& material,
                         nlohmann::json& m) {
    if (material.alphaMode == scene::AlphaMode::mask) {
        m["alphaMode"] = "MASK";
        m["alphaCutoff"] = material.alphaCutoff;
    } else if (material.alphaMode == scene::AlphaMode::blend) {
        m["alphaMode"] = "BLEND";
    }
    if (!material.isEmissive()) {
        return;
    }
    const float most = std::max({material.emission.r, material.emission.g, material.emission.b});
    useExtension(glb, "KHR_materials_emissive_strength");
    m["emissiveFactor"] = toJson(material.emission / most);
    m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
        static_cast<double>(most) / base::kPi;
    if (material.emissionTexture.isSet()) {
        m["emissiveTexture"] = textures.info(material.emissionTexture);
    }
}

}  // namespace fluxwalk::io
