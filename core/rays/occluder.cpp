#include "core/rays/occluder.h"

namespace fluxwalk::rays {

namespace {

// Blended surfaces let all light pass, as do masked ones whose alpha is everywhere below the cutoff.
bool blocksLight(const scene::Material& material) {
    const bool isAllHole = material.alphaMode == scene::AlphaMode::mask &&
                           !material.reflectanceTexture.isSet() && material.alpha < material.alphaCutoff;
    return material.alphaMode != scene::AlphaMode::blend && !isAllHole;
}

}  // namespace

bool Occluder::isHole(std::uint32_t patch, const base::Vec2d& uv) const {
    return cutOut != nullptr &&
           scene::coverageAt(*cutOut, *textures,
                             surface->texcoord(patch, uv, cutOut->reflectanceTexture.texcoordSet)) == 0.0f;
}

std::optional<surface::SurfaceHit> Occluder::meet(const base::Vec3d& origin, const base::Vec3d& direction,
                                                  double tNear, double tFar) const {
    auto found = surface->intersect(origin, direction, tNear, tFar);
    while (found && isHole(found->patch, found->uv)) {
        found = surface->intersect(origin, direction, found->t, tFar);
    }
    return found;
}

Occluders::Occluders(const scene::Scene& scene) : objects(scene.objects.size()) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const scene::Object& object = scene.objects[i];
        const scene::Material& material = scene.materials[object.material];
        if (object.surface->patchCount() == 0 || !blocksLight(material)) {
            continue;
        }
        objects[i] = {object.surface.get(), object.surface->triangles().patches, nullptr, nullptr};
        if (material.alphaMode == scene::AlphaMode::mask && material.reflectanceTexture.isSet()) {
            if (!textures) {
                textures.emplace(scene);
            }
            objects[i].cutOut = &material;
            objects[i].textures = &*textures;
        }
    }
}

}  // namespace fluxwalk::rays
