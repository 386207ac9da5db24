#include "core/scene/describe.h"

#include <algorithm>

#include "core/base/photometry.h"

namespace fluxwalk::scene {

namespace {

SurfaceKindDescription& kindEntry(std::vector<SurfaceKindDescription>& kinds, std::string_view kind) {
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [kind](const auto& entry) { return entry.kind == kind; });
    return found != kinds.end() ? *found : kinds.emplace_back(SurfaceKindDescription{kind, 0, 0, 0.0});
}

void addObject(SceneDescription& description, const Scene& scene, const TextureSet& textures,
               const Object& object) {
    const surface::Surface& surface = *object.surface;
    const Material& material = scene.materials[object.material];
    EmitterDescription emitter;
    emitter.object = object.name;
    emitter.patches = surface.patchCount();
    emitter.doubleSided = material.doubleSided;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
        const surface::Region whole = surface::wholePatch(surface.domain(patch));
        const double area = surface.area(patch, whole);
        emitter.area += area;
        if (material.isEmissive()) {
            const Rgb emission = regionMaterial(scene, textures, object, patch, whole).emission;
            emitter.flux += (material.doubleSided ? 2.0 : 1.0) * area * base::Vec3d(emission);
        }
    }
    SurfaceKindDescription& kind = kindEntry(description.kinds, surface.kind());
    ++kind.objects;
    kind.patches += surface.patchCount();
    kind.area += emitter.area;
    description.patches += surface.patchCount();
    description.triangles += surface.triangles().triangles.size();
    description.area += emitter.area;
    description.doubleSidedArea += material.doubleSided ? emitter.area : 0.0;
    if (material.isEmissive()) {
        emitter.lumens = base::luminance(emitter.flux);
        description.lumens += emitter.lumens;
        description.emittingArea += emitter.area;
        description.emitters.push_back(std::move(emitter));
    }
}

}  // namespace

std::string_view nameOf(LightKind kind) {
    switch (kind) {
        case LightKind::point:
            return "point";
        case LightKind::spot:
            return "spot";
        case LightKind::directional:
            break;
    }
    return "directional";
}

SceneDescription describeScene(const Scene& scene, const TextureSet& textures) {
    SceneDescription description;
    description.name = scene.name;
    description.objects = scene.objects.size();
    description.droppedTriangles = scene.droppedTriangleCount;
    for (const Object& object : scene.objects) {
        addObject(description, scene, textures, object);
    }
    description.sides = 2 * description.patches;
    for (const Light& light : scene.lights) {
        const double lumens = base::luminance(base::Vec3d(fluxOf(light)));
        description.lights.push_back({light.name, light.kind, light.intensity, lumens});
        description.lumens += lumens;
    }
    description.sky = scene.sky;
    description.materials = scene.materials.size();
    description.images = scene.images.size();
    description.bounds = scene.bounds();
    for (const Camera& camera : scene.cameras) {
        description.cameras.push_back(camera.name);
    }
    description.warnings = scene.warnings;
    return description;
}

}  // namespace fluxwalk::scene
