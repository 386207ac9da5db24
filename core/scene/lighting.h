#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.h"

/// Lights as they are turned, beside the scene that says how bright they are.
namespace fluxwalk::scene {

/// Factors in linear RGB on what the scene emits: 1 as it is, 0 switched off. What is not in the lists is as
/// it is.
struct Lighting {
    std::vector<Rgb> materials;  ///< of the emission, by index into Scene::materials
    std::vector<Rgb> lights;     ///< of the intensity, by index into Scene::lights
    Rgb sky{1.0f};

    Rgb ofMaterial(std::size_t index) const;
    Rgb ofLight(std::size_t index) const;
    /// Whether all is as the scene says.
    bool isNeutral() const { return *this == Lighting{}; }
    /// Lists of different lengths may say the same.
    bool operator==(const Lighting& other) const;
};

/// The largest factor.
inline constexpr float kLargestLightFactor = 1000.0f;

/// Something in a scene that shines: a material in use, a light without area, the sky.
struct LightSource {
    enum class Kind : std::uint8_t { material, light, sky };

    Kind kind = Kind::material;
    std::size_t index = 0;
    std::string name;   ///< "material 3", "light 1" where the scene gives none; "sky"
    Rgb emitted{0.0f};  ///< lm/m2, cd (directional: lux), lux
};

/// In the order of the scene: materials, lights, sky.
std::vector<LightSource> listLightSources(const Scene& scene);

Rgb factorOf(const Lighting& lighting, const LightSource& source);
void setFactor(Lighting& lighting, const LightSource& source, const Rgb& factor);

/// The scene as these lights make it: the same one where they are neutral.
std::shared_ptr<const Scene> relightScene(std::shared_ptr<const Scene> scene, const Lighting& lighting);

}  // namespace fluxwalk::scene
