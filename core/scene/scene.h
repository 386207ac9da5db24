#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/bounds.h"
#include "core/scene/material.h"
#include "core/surface/surface.h"

/// A scene: exact objects, materials, lights and cameras. Metres, y up.
namespace fluxwalk::scene {

using base::Box;
using base::Vec3;
using base::Vec3d;

/// One exact surface with one material.
struct Object {
    std::string name;
    std::shared_ptr<const surface::Surface> surface;
    std::uint32_t material = 0;  ///< index into Scene::materials
};

enum class LightKind : std::uint8_t { point, spot, directional };

/// Light without area (KHR_lights_punctual).
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    /// Point and spot: luminous intensity in cd. Directional: illuminance in lux on a plane that faces it.
    Rgb intensity{1.0f};
    Vec3d position{0.0};
    Vec3d direction{0.0, -1.0, 0.0};  ///< unit, in which the light goes
    double innerConeAngle = 0.0;      ///< spot: full intensity within, radians
    double outerConeAngle = 0.7853981633974483;
    double range = 0.0;  ///< metres beyond which it does not reach, 0 for none (a warning says that this is
                         ///< not physical)
};

/// Intensity in cd that a point or spot light sends into unit direction `d`, glTF's smooth cone included.
Rgb intensityToward(const Light& light, const Vec3d& d);
/// Whether a point or spot light reaches a point at this squared distance in m2.
inline bool reaches(const Light& light, double squaredDistance) {
    return light.range <= 0.0 || squaredDistance <= light.range * light.range;
}
/// Flux in lm over all directions; zero for directional lights, whose flux depends on what they meet.
Rgb fluxOf(const Light& light);

struct Camera {
    std::string name;
    Vec3d position{0.0};
    Vec3d forward{0.0, 0.0, -1.0};
    Vec3d up{0.0, 1.0, 0.0};
    double verticalFov = 0.9;  ///< radians
    double nearPlane = 0.01;   ///< metres
};

struct Scene {
    std::string name;
    std::vector<Object> objects;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    /// Uniform sky over the upper hemisphere: the illuminance in lux that it gives on an unobstructed
    /// horizontal plane.
    Rgb sky{0.0f};
    /// Said to the user, one line each, with the place in the file.
    std::vector<std::string> warnings;
    std::size_t droppedTriangleCount = 0;

    Box bounds() const;
    /// Whether anything emits: an emissive material in use, a light or the sky.
    bool hasLight() const;
};

/// Illuminance of the sky that lights a scene without any light, unless the user says otherwise (DESIGN
/// section 8).
inline constexpr float kDefaultSky = 1000.0f;

/// Gives a scene without light the default sky and a warning that says so.
void applyDefaultSky(Scene& scene);

}  // namespace fluxwalk::scene
