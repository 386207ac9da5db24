#include <utility>

#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::hierarchy {

void Hierarchy::relight(const scene::Lighting& lighting, const base::Executor& executor) {
    const scene::Lighting before = std::exchange(lighting_, lighting);
    for (const NodeId id : sources_) {
        Light& source = light(id);
        const bool isSky = kind(id) == NodeKind::sky;
        source.emission = isSky
                              ? scene_->sky * lighting_.sky
                              : scene_->lights[lightIndex(id)].intensity * lighting_.ofLight(lightIndex(id));
        source.radiosity = source.emission;
    }
    executor.forRange(nodeCount(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId id{static_cast<std::uint32_t>(i)};
            if (kind(id) != NodeKind::element) {
                continue;
            }
            const std::uint32_t material = scene_->objects[object_[i]].material;
            if (!scene_->materials[material].isEmissive() ||
                before.ofMaterial(material) == lighting_.ofMaterial(material)) {
                continue;
            }
            // What is reflected stays, what is emitted shows at once.
            const Rgb emission = emissionOf(id, region(id));
            light_[i].radiosity = glm::max(light_[i].radiosity + (emission - light_[i].emission), Rgb(0.0f));
            light_[i].emission = emission;
        }
    });
    pullClusters();
}

Rgb Hierarchy::emissionOf(NodeId id, const surface::Region& region) const {
    const ElementName at = name(id);
    const scene::Object& object = scene_->objects[at.object];
    if (at.back && !scene_->materials[object.material].doubleSided) {
        return Rgb(0.0f);
    }
    return scene::regionMaterial(*scene_, textures_, object, at.patch, region).emission *
           lighting_.ofMaterial(object.material);
}

}  // namespace fluxwalk::hierarchy
