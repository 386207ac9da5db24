#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/building.h"

namespace fluxwalk::scene::building {

namespace {

/// Colours of light, about 4,000 K and 2,800 K; their luminance plays no part.
constexpr Rgb kNeutral(1.12f, 0.98f, 0.80f);
constexpr Rgb kWarm(1.40f, 0.94f, 0.48f);

// A material that sends so many lumens of a colour from so many square metres.
std::uint32_t addGlow(Scene& scene, std::string name, const Rgb& colour, double lumens, double area) {
    const auto scale = static_cast<float>(lumens / (area * static_cast<double>(base::luminance(colour))));
    return addMaterial(scene, std::move(name), Rgb(0.7f), colour * scale);
}

template <std::size_t n>
std::array<std::uint32_t, n> addAll(Scene& scene, const std::string& name, const std::array<Rgb, n>& rgb) {
    std::array<std::uint32_t, n> made{};
    for (std::size_t i = 0; i < n; ++i) {
        made[i] = addMaterial(scene, name + " " + std::to_string(i + 1), rgb[i]);
    }
    return made;
}

}  // namespace

Palette addPalette(Scene& scene) {
    Palette p;
    p.walls = addAll<6>(scene, "wall paint",
                        {Rgb{0.80f, 0.78f, 0.73f},
                         {0.78f, 0.70f, 0.54f},
                         {0.58f, 0.68f, 0.70f},
                         {0.66f, 0.72f, 0.56f},
                         {0.74f, 0.58f, 0.50f},
                         {0.70f, 0.68f, 0.74f}});
    p.floors = addAll<5>(scene, "floor",
                         {Rgb{0.42f, 0.29f, 0.18f},
                          {0.30f, 0.19f, 0.11f},
                          {0.24f, 0.27f, 0.31f},
                          {0.52f, 0.44f, 0.34f},
                          {0.38f, 0.36f, 0.33f}});
    p.woods = addAll<4>(
        scene, "wood",
        {Rgb{0.55f, 0.40f, 0.25f}, {0.30f, 0.18f, 0.10f}, {0.62f, 0.52f, 0.38f}, {0.44f, 0.27f, 0.15f}});
    p.cloths = addAll<6>(scene, "cloth",
                         {Rgb{0.48f, 0.10f, 0.08f},
                          {0.10f, 0.18f, 0.38f},
                          {0.16f, 0.30f, 0.18f},
                          {0.60f, 0.54f, 0.44f},
                          {0.52f, 0.33f, 0.09f},
                          {0.22f, 0.22f, 0.25f}});
    p.colours = addAll<8>(scene, "colour",
                          {Rgb{0.52f, 0.08f, 0.07f},
                           {0.09f, 0.16f, 0.40f},
                           {0.12f, 0.32f, 0.20f},
                           {0.62f, 0.45f, 0.10f},
                           {0.65f, 0.61f, 0.52f},
                           {0.14f, 0.12f, 0.13f},
                           {0.42f, 0.20f, 0.32f},
                           {0.16f, 0.38f, 0.44f}});
    p.white = addMaterial(scene, "white paint", Rgb(0.84f, 0.83f, 0.80f));
    p.concrete = addMaterial(scene, "concrete", Rgb(0.46f, 0.45f, 0.43f));
    p.stone = addMaterial(scene, "stone", Rgb(0.50f, 0.48f, 0.44f));
    p.metal = addMaterial(scene, "grey metal", Rgb(0.58f));
    p.steel = addMaterial(scene, "steel", Rgb(0.42f, 0.43f, 0.45f));
    p.black = addMaterial(scene, "black plastic", Rgb(0.05f));
    p.pane = addMaterial(scene, "night pane", Rgb(0.03f, 0.05f, 0.09f));
    p.paper = addMaterial(scene, "paper", Rgb(0.80f, 0.79f, 0.75f));
    p.leaf = addMaterial(scene, "leaf", Rgb(0.10f, 0.26f, 0.06f));
    p.clay = addMaterial(scene, "clay", Rgb(0.48f, 0.24f, 0.14f));
    p.shade = addMaterial(scene, "lampshade", Rgb(0.72f, 0.64f, 0.48f));
    // Other viewers would otherwise leave out the insides of the shades.
    scene.materials[p.shade].doubleSided = true;
    const auto sphere = [](double radius) { return 4.0 * base::kPi * radius * radius; };
    p.panelLight = addGlow(scene, "panel", kNeutral, kPanelLumens, kPanelLength * kPanelWidth);
    p.bulbLight = addGlow(scene, "bulb", kWarm, kBulbLumens, sphere(kBulbRadius));
    p.globeLight = addGlow(scene, "globe", kWarm, kGlobeLumens, sphere(kGlobeRadius));
    return p;
}

}  // namespace fluxwalk::scene::building
