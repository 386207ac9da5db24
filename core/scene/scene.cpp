#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::scene {

namespace {

// glTF's recommended falloff (KHR_lights_punctual): quadratic in the cosine between the two cones.
double spotFactor(const Light& light, double cosine) {
    const double cosOuter = std::cos(light.outerConeAngle);
    const double scale = 1.0 / std::max(1e-3, std::cos(light.innerConeAngle) - cosOuter);
    const double f = std::clamp((cosine - cosOuter) * scale, 0.0, 1.0);
    return f * f;
}

}  // namespace

Rgb intensityToward(const Light& light, const Vec3d& d) {
    if (light.kind != LightKind::spot) {
        return light.intensity;
    }
    return light.intensity * static_cast<float>(spotFactor(light, glm::dot(light.direction, d)));
}

Rgb fluxOf(const Light& light) {
    switch (light.kind) {
        case LightKind::point:
            return light.intensity * static_cast<float>(4.0 * base::kPi);
        case LightKind::spot: {
            // 2 pi times the integral over the cosine of the falloff: the full cone, then a square between
            // the cones.
            const double cosOuter = std::cos(light.outerConeAngle);
            const double width = std::max(1e-3, std::cos(light.innerConeAngle) - cosOuter);
            const double full = std::max(0.0, 1.0 - (cosOuter + width));
            return light.intensity * static_cast<float>(2.0 * base::kPi * (full + width / 3.0));
        }
        case LightKind::directional:
            break;
    }
    return Rgb(0.0f);
}

Box Scene::bounds() const {
    Box box;
    for (const Object& object : objects) {
        box.extend(object.surface->bounds());
    }
    return box;
}

bool Scene::hasLight() const {
    const bool emits = std::any_of(objects.begin(), objects.end(), [this](const Object& object) {
        return object.surface->patchCount() > 0 && materials[object.material].isEmissive();
    });
    return emits || !lights.empty() || sky != Rgb(0.0f);
}

void applyDefaultSky(Scene& scene) {
    if (!scene.hasLight()) {
        scene.sky = Rgb(kDefaultSky);
        scene.warnings.emplace_back(
            "the scene has no light: lit by a uniform sky of 1000 lx (--sky LUX, 0 for dark)");
    }
}

}  // namespace fluxwalk::scene
