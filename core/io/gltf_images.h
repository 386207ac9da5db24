#pragma once

#include <cstdint>
#include <vector>

#include "core/io/gltf_model.h"
#include "core/scene/scene.h"

namespace fluxwalk::io {

/// Decodes the images that textures name, each once and only when asked for, into a scene.
class ImageTable {
  public:
    ImageTable(GltfModel& model, scene::Scene& scene);

    /// Index into Scene::images of a texture's picture. One that is missing or cannot be decoded becomes mid
    /// grey with a warning.
    std::int32_t imageOf(int texture, const std::string& place);

  private:
    std::int32_t add(scene::Image image);
    std::int32_t addGrey(const std::string& place, const std::string& why);

    GltfModel& model_;
    scene::Scene& scene_;
    /// By image of the file: index into Scene::images, -1 until asked for.
    std::vector<std::int32_t> decoded_;
    std::uint64_t pixelsLeft_;
};

}  // namespace fluxwalk::io
