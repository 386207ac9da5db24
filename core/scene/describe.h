#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/texture.h"

/// What was understood of a scene, for `fluxwalk info` and for tests of the readers.
namespace fluxwalk::scene {

/// An object that emits.
struct EmitterDescription {
    std::string object;
    std::size_t patches = 0;
    double area = 0.0;         ///< m2 of one side
    base::Vec3d flux{0.0};     ///< lm per channel, from both sides where the material is doubleSided
    double lumens = 0.0;       ///< luminance of `flux`
    bool doubleSided = false;  ///< emits from its back too
};

/// A light without area.
struct LightDescription {
    std::string name;
    LightKind kind = LightKind::point;
    Rgb intensity{0.0f};  ///< cd, or lux for directional lights
    double lumens = 0.0;  ///< 0 for directional lights, whose flux depends on what they meet
};

/// All objects with surfaces of one kind.
struct SurfaceKindDescription {
    std::string_view kind;  ///< Surface::kind()
    std::size_t objects = 0;
    std::size_t patches = 0;
    double area = 0.0;  ///< m2 of one side
};

struct SceneDescription {
    std::string name;
    std::size_t objects = 0;
    std::size_t patches = 0;
    std::size_t triangles = 0;  ///< of polygon meshes
    std::size_t droppedTriangles = 0;
    std::size_t sides = 0;  ///< two for each patch
    double area = 0.0;      ///< m2 of one side of everything
    double emittingArea = 0.0;
    double doubleSidedArea =
        0.0;  ///< of materials marked so in the file; every surface reflects on both sides
    std::vector<SurfaceKindDescription> kinds;  ///< in the order of their first object
    std::vector<EmitterDescription> emitters;   ///< in the order of the objects
    std::vector<LightDescription> lights;
    double lumens = 0.0;  ///< of emitters, point and spot lights together
    Rgb sky{0.0f};        ///< lux on a horizontal plane
    std::size_t materials = 0;
    std::size_t images = 0;
    Box bounds;  ///< metres
    std::vector<std::string> cameras;
    std::vector<std::string> warnings;
};

/// One line that names the units of all numbers above.
inline constexpr std::string_view kDescriptionUnits =
    "metres, y up; areas in m2, flux in lm, intensity in cd, illuminance in lux";

SceneDescription describeScene(const Scene& scene, const TextureSet& textures);

std::string_view nameOf(LightKind kind);

}  // namespace fluxwalk::scene
