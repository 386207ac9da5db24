#include "core/io/gltf_materials.h"

#include <algorithm>
#include <array>

#include "core/base/photometry.h"

namespace fluxwalk::io {

namespace {

using base::Rgb;

/// Brightest exitance per channel that is believed (a thousand suns): beyond it float sums lose their digits.
constexpr double kMaxExitance = 1e13;

class MaterialReader {
  public:
    MaterialReader(GltfModel& model, scene::Scene& scene)
        : model_(model), scene_(scene), images_(model, scene) {}

    void run() {
        for (std::size_t i = 0; i < model_.data.materials.size(); ++i) {
            place_ = "/materials/" + std::to_string(i);
            scene_.materials.push_back(read(model_.data.materials[i]));
        }
    }

  private:
    void warn(const std::string& message) { model_.warnings.add(message, place_); }

    scene::Material read(const tinygltf::Material& source) {
        scene::Material material;
        material.name = source.name;
        if (!source.name.empty()) {
            place_ += " '" + source.name + "'";
        }
        material.doubleSided = source.doubleSided;
        readReflectance(source, material);
        readAlpha(source, material);
        readEmission(source, material);
        if (source.normalTexture.index >= 0) {
            const tinygltf::NormalTextureInfo& info = source.normalTexture;
            material.normalTexture = textureOf(info.index, info.texCoord, info.extensions);
            material.normalScale = toFloat(info.scale);
        }
        if (const auto bump = findIndex(source.extras, "fluxwalk_bump")) {
            material.bumpTexture = textureOf(*bump, 0, {});
            if (const auto height = findNumber(source.extras, "fluxwalk_bump_height")) {
                material.bumpHeight = toFloat(*height);
            }
        }
        nameUnsupported(source, material);
        return material;
    }

    void readReflectance(const tinygltf::Material& source, scene::Material& material) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        for (int c = 0; c < 3; ++c) {
            const double factor = pbr.baseColorFactor[static_cast<std::size_t>(c)];
            if (!(factor >= 0.0 && factor <= 1.0)) {
                warn("the base colour is not within 0 and 1; clamped");
            }
            material.reflectance[c] = static_cast<float>(std::clamp(factor, 0.0, 1.0));
        }
        const tinygltf::TextureInfo& info = pbr.baseColorTexture;
        if (info.index >= 0) {
            material.reflectanceTexture = textureOf(info.index, info.texCoord, info.extensions);
        }
        const Rgb brightest = material.reflectance * brightestTexel(material.reflectanceTexture);
        if (std::max({brightest.r, brightest.g, brightest.b}) > scene::kMaxReflectance) {
            warn("the reflectance exceeds 0.98; clamped");
        }
        if (!material.reflectanceTexture.isSet()) {
            material.reflectance = glm::min(material.reflectance, Rgb(scene::kMaxReflectance));
        }
        if (pbr.metallicFactor > 0.0 && pbr.metallicRoughnessTexture.index < 0) {
            warn("a metal is treated as diffuse, with its base colour as reflectance");
        }
    }

    void readAlpha(const tinygltf::Material& source, scene::Material& material) {
        material.alpha =
            static_cast<float>(std::clamp(source.pbrMetallicRoughness.baseColorFactor[3], 0.0, 1.0));
        if (source.alphaMode == "MASK") {
            material.alphaMode = scene::AlphaMode::mask;
            material.alphaCutoff = static_cast<float>(std::clamp(source.alphaCutoff, 0.0, 2.0));
        } else if (source.alphaMode == "BLEND") {
            material.alphaMode = scene::AlphaMode::blend;
            warn("a blended material does not block light");
        } else if (source.alphaMode != "OPAQUE") {
            warn("the alpha mode '" + source.alphaMode + "' is not known; opaque");
        }
    }

    void readEmission(const tinygltf::Material& source, scene::Material& material) {
        double strength = 1.0;
        if (const auto* ext = findExtension(source.extensions, "KHR_materials_emissive_strength")) {
            strength = std::clamp(findNumber(*ext, "emissiveStrength").value_or(1.0), 0.0, 1e30);
        }
        for (int c = 0; c < 3; ++c) {
            const double emission = base::kPi * strength * source.emissiveFactor[static_cast<std::size_t>(c)];
            if (!(emission >= 0.0 && emission <= kMaxExitance)) {
                warn("the emission is not within 0 and 1e13 lm/m2; clamped");
            }
            material.emission[c] = static_cast<float>(std::clamp(emission, 0.0, kMaxExitance));
        }
        const tinygltf::TextureInfo& info = source.emissiveTexture;
        if (info.index >= 0 && material.isEmissive()) {
            material.emissionTexture = textureOf(info.index, info.texCoord, info.extensions);
        }
    }

    void nameUnsupported(const tinygltf::Material& source, scene::Material& material) {
        if (source.extensions.count("KHR_materials_unlit") != 0) {
            warn("KHR_materials_unlit: an unlit material is treated as diffuse");
        }
        if (const auto* ext = findExtension(source.extensions, "KHR_materials_transmission")) {
            if (findNumber(*ext, "transmissionFactor").value_or(0.0) > 0.0) {
                material.alphaMode = scene::AlphaMode::blend;
                warn("KHR_materials_transmission: a transmitting material does not block light");
            }
        }
    }

    // Largest value of each channel in linear light, opaque enough or not; white for no texture.
    Rgb brightestTexel(const scene::TextureRef& texture) const {
        if (!texture.isSet()) {
            return Rgb(1.0f);
        }
        const scene::Image& image = scene_.images[static_cast<std::size_t>(texture.image)];
        std::array<std::uint8_t, 3> most{};
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
            for (std::size_t c = 0; c < 3; ++c) {
                most[c] = std::max(most[c], image.rgba[i + c]);
            }
        }
        Rgb result(0.0f);
        for (int c = 0; c < 3; ++c) {
            result[c] = static_cast<float>(base::linearFromSrgb(most[static_cast<std::size_t>(c)] / 255.0));
        }
        return result;
    }

    scene::TextureRef textureOf(int texture, int texcoordSet, const tinygltf::ExtensionMap& extensions) {
        scene::TextureRef ref;
        ref.image = images_.imageOf(texture, place_);
        const int sampler = model_.at(model_.data.textures, texture, place_).sampler;
        if (sampler >= 0) {
            const tinygltf::Sampler& s = model_.at(model_.data.samplers, sampler, place_);
            ref.wrapU = wrapOf(s.wrapS);
            ref.wrapV = wrapOf(s.wrapT);
        }
        if (const auto* transform = findExtension(extensions, "KHR_texture_transform")) {
            texcoordSet = findIndex(*transform, "texCoord").value_or(texcoordSet);
            if (const auto offset = findNumbers(*transform, "offset", 2); !offset.empty()) {
                ref.offset = {toFloat(offset[0]), toFloat(offset[1])};
            }
            if (const auto scale = findNumbers(*transform, "scale", 2); !scale.empty()) {
                ref.scale = {toFloat(scale[0]), toFloat(scale[1])};
            }
            ref.rotation = toFloat(findNumber(*transform, "rotation").value_or(0.0));
        }
        if (texcoordSet > 1) {
            warn("texture coordinates beyond TEXCOORD_1 are not supported; TEXCOORD_0 is used");
            texcoordSet = 0;
        }
        ref.texcoordSet = static_cast<std::uint8_t>(texcoordSet);
        return ref;
    }

    static scene::Wrap wrapOf(int mode) {
        switch (mode) {
            case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
                return scene::Wrap::clamp;
            case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
                return scene::Wrap::mirror;
            default:
                return scene::Wrap::repeat;
        }
    }

    GltfModel& model_;
    scene::Scene& scene_;
    ImageTable images_;
    std::string place_;
};

}  // namespace

void readMaterials(GltfModel& model, scene::Scene& scene) {
    MaterialReader(model, scene).run();
}

}  // namespace fluxwalk::io
