#include "core/scene/lighting.h"

#include <algorithm>
#include <utility>

namespace fluxwalk::scene {

namespace {

Rgb at(const std::vector<Rgb>& factors, std::size_t index) {
    return index < factors.size() ? factors[index] : Rgb(1.0f);
}

bool areSame(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
        if (at(a, i) != at(b, i)) {
            return false;
        }
    }
    return true;
}

void put(std::vector<Rgb>& factors, std::size_t index, const Rgb& factor) {
    if (factors.size() <= index) {
        factors.resize(index + 1, Rgb(1.0f));
    }
    factors[index] = factor;
}

bool isDark(const Rgb& value) {
    return value == Rgb(0.0f);
}

}  // namespace

Rgb Lighting::ofMaterial(std::size_t index) const {
    return at(materials, index);
}

Rgb Lighting::ofLight(std::size_t index) const {
    return at(lights, index);
}

bool Lighting::operator==(const Lighting& other) const {
    return sky == other.sky && areSame(materials, other.materials) && areSame(lights, other.lights);
}

std::vector<LightSource> listLightSources(const Scene& scene) {
    std::vector<bool> isUsed(scene.materials.size(), false);
    for (const Object& object : scene.objects) {
        isUsed[object.material] = true;
    }
    std::vector<LightSource> sources;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (isUsed[i] && material.isEmissive()) {
            sources.push_back({LightSource::Kind::material, i,
                               material.name.empty() ? "material " + std::to_string(i) : material.name,
                               material.emission});
        }
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (!isDark(light.intensity)) {
            sources.push_back({LightSource::Kind::light, i,
                               light.name.empty() ? "light " + std::to_string(i) : light.name,
                               light.intensity});
        }
    }
    if (!isDark(scene.sky)) {
        sources.push_back({LightSource::Kind::sky, 0, "sky", scene.sky});
    }
    return sources;
}

Rgb factorOf(const Lighting& lighting, const LightSource& source) {
    switch (source.kind) {
        case LightSource::Kind::material:
            return lighting.ofMaterial(source.index);
        case LightSource::Kind::light:
            return lighting.ofLight(source.index);
        case LightSource::Kind::sky:
            break;
    }
    return lighting.sky;
}

void setFactor(Lighting& lighting, const LightSource& source, const Rgb& factor) {
    switch (source.kind) {
        case LightSource::Kind::material:
            put(lighting.materials, source.index, factor);
            return;
        case LightSource::Kind::light:
            put(lighting.lights, source.index, factor);
            return;
        case LightSource::Kind::sky:
            break;
    }
    lighting.sky = factor;
}

std::shared_ptr<const Scene> relightScene(std::shared_ptr<const Scene> scene, const Lighting& lighting) {
    if (lighting.isNeutral()) {
        return scene;
    }
    Scene lit = *scene;
    for (std::size_t i = 0; i < lit.materials.size(); ++i) {
        lit.materials[i].emission *= lighting.ofMaterial(i);
    }
    for (std::size_t i = 0; i < lit.lights.size(); ++i) {
        lit.lights[i].intensity *= lighting.ofLight(i);
    }
    lit.sky *= lighting.sky;
    return std::make_shared<const Scene>(std::move(lit));
}

}  // namespace fluxwalk::scene
