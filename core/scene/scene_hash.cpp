#include "core/scene/scene_hash.h"

#include "core/base/hash.h"
#include "core/surface/region.h"

namespace fluxwalk::scene {

namespace {

using base::Hasher;
using base::Vec2d;

/// Points of a curved patch along each parameter.
constexpr unsigned kSteps = 5;

void addTexcoords(Hasher& hash, const surface::Surface& surface, std::uint32_t patch, const Vec2d& uv) {
    hash.add(surface.texcoord(patch, uv, 0));
    hash.add(surface.texcoord(patch, uv, 1));
}

void addPatch(Hasher& hash, const surface::Surface& surface, std::uint32_t patch) {
    const surface::Region whole = surface::wholePatch(surface.domain(patch));
    hash.add(std::uint64_t{whole.cornerCount});
    if (surface.isPlanar(patch)) {
        for (std::uint32_t i = 0; i < whole.cornerCount; ++i) {
            hash.add(surface.evaluate(patch, whole.corners[i]).position);
            addTexcoords(hash, surface, patch, whole.corners[i]);
        }
        return;
    }
    for (unsigned i = 0; i < kSteps; ++i) {
        for (unsigned j = 0; j < kSteps; ++j) {
            // Off the borders, where rows of patches may meet in one point.
            const Vec2d st((i + 0.5) / kSteps, (j + 0.5) / kSteps);
            const Vec2d uv = surface::mapToRegion(whole, st).uv;
            const surface::SurfacePoint point = surface.evaluate(patch, uv);
            hash.add(point.position);
            hash.add(point.normal);
            addTexcoords(hash, surface, patch, uv);
        }
    }
}

void addTexture(Hasher& hash, const Scene& scene, const TextureRef& texture) {
    hash.add(std::uint64_t{texture.isSet()});
    if (!texture.isSet()) {
        return;
    }
    hash.add(std::uint64_t{texture.texcoordSet});
    hash.add(static_cast<std::uint64_t>(texture.wrapU));
    hash.add(static_cast<std::uint64_t>(texture.wrapV));
    hash.add(texture.offset);
    hash.add(texture.scale);
    hash.add(texture.rotation);
    const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    hash.add(std::uint64_t{image.width});
    hash.add(std::uint64_t{image.height});
    hash.addBytes(image.rgba);
}

void addMaterial(Hasher& hash, const Scene& scene, const Material& material) {
    hash.add(material.reflectance);
    addTexture(hash, scene, material.reflectanceTexture);
    hash.add(material.emission);
    addTexture(hash, scene, material.emissionTexture);
    hash.add(std::uint64_t{material.doubleSided});
    hash.add(static_cast<std::uint64_t>(material.alphaMode));
    hash.add(material.alpha);
    hash.add(material.alphaCutoff);
}

void addLight(Hasher& hash, const Light& light) {
    hash.add(static_cast<std::uint64_t>(light.kind));
    hash.add(light.intensity);
    hash.add(light.position);
    hash.add(light.direction);
    hash.add(light.innerConeAngle);
    hash.add(light.outerConeAngle);
    hash.add(light.range);
}

}  // namespace

std::uint64_t hashScene(const Scene& scene) {
    Hasher hash;
    hash.add(std::uint64_t{scene.objects.size()});
    for (const Object& object : scene.objects) {
        const surface::Surface& surface = *object.surface;
        hash.add(std::uint64_t{object.material});
        hash.add(std::uint64_t{surface.patchCount()});
        for (std::uint32_t p = 0; p < surface.patchCount(); ++p) {
            addPatch(hash, surface, p);
        }
    }
    hash.add(std::uint64_t{scene.materials.size()});
    for (const Material& material : scene.materials) {
        addMaterial(hash, scene, material);
    }
    hash.add(std::uint64_t{scene.lights.size()});
    for (const Light& light : scene.lights) {
        addLight(hash, light);
    }
    hash.add(scene.sky);
    return hash.value();
}

}  // namespace fluxwalk::scene
