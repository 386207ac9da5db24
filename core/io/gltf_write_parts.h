#pragma once

#include <map>

#include "core/io/glb_write.h"
#include "core/scene/scene.h"

/// What all glTF files that are written have in common.
namespace fluxwalk::io {

nlohmann::json toJson(const base::Rgb& c);

/// Names an extension in extensionsUsed, once.
void useExtension(GlbBuilder& glb, const char* name);

/// Adds a camera and returns the node that places it.
nlohmann::json cameraNode(GlbBuilder& glb, const scene::Camera& camera);

/// Embeds the pictures that are referred to, each once, as PNG.
class TextureWriter {
  public:
    TextureWriter(GlbBuilder& glb, const scene::Scene& scene) : glb_(glb), scene_(scene) {}

    /// A textureInfo object for a reference that is set.
    nlohmann::json info(const scene::TextureRef& texture);

  private:
    std::size_t imageIndex(std::int32_t image);

    GlbBuilder& glb_;
    const scene::Scene& scene_;
    std::map<std::int32_t, std::size_t> imageIndex_;
};

/// Alpha mode and emission of a material, into its JSON.
void addAlphaAndEmission(GlbBuilder& glb, TextureWriter& textures, const scene::Material& material,
                         nlohmann::json& m);

}  // namespace fluxwalk::io
