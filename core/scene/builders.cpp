#include "core/scene/builders.h"

#include <algorithm>
#include <array>

#include "core/base/photometry.h"

namespace fluxwalk::scene {

namespace {

// A warm lamp of 800 lm, as a household bulb of 60 W gives.
Scene buildLitCornellBox() {
    constexpr float kFlux = 800.0f;
    constexpr float kArea = 0.130f * 0.105f;
    const Rgb colour(17.0f, 12.0f, 4.0f);
    return buildCornellBox(colour * (kFlux / (kArea * base::luminance(colour))));
}

Scene buildUnitCornellBox() {
    Scene scene = buildCornellBox(Rgb(1.0f));
    scene.name = "cornell-box-unit";
    return scene;
}

Scene named(std::string_view name, Scene scene) {
    scene.name = name;
    return scene;
}

constexpr std::array kScenes{
    BuiltInScene{"gallery", "the demo: a vaulted hall with columns, vases, a torus and lamps", buildGallery},
    BuiltInScene{"cornell-box", "the Cornell box with a warm lamp of 800 lm", buildLitCornellBox},
    BuiltInScene{"cornell-box-unit",
                 "the Cornell box, lamp 1 lm/m2 in every channel (reference values known)",
                 buildUnitCornellBox},
    BuiltInScene{"furnace", "closed room, two blocks and a sphere, all glowing: B = 2 lm/m2 everywhere",
                 [] { return buildFurnace(0.5f, true); }},
    BuiltInScene{"furnace-planar", "the furnace without its sphere",
                 [] { return buildFurnace(0.5f, false); }},
    BuiltInScene{"squares-parallel", "two unit squares 1 m apart, F = .199825",
                 [] { return named("squares-parallel", buildParallelSquares(1.0)); }},
    BuiltInScene{"squares-close", "two unit squares 1 cm apart, F = .980417",
                 [] { return named("squares-close", buildParallelSquares(0.01)); }},
    BuiltInScene{"squares-perpendicular", "two unit squares that share an edge at 90 degrees, F = .200044",
                 [] { return named("squares-perpendicular", buildWedge(90.0)); }},
    BuiltInScene{"wedge-30", "two unit squares that share an edge at 30 degrees, F = .619028",
                 [] { return named("wedge-30", buildWedge(30.0)); }},
    BuiltInScene{"cie-5.8", "CIE 171 test 5.8: cube of 4 m, point source of 10,000 lm, reflectance .5",
                 [] { return buildCie58(0.5f); }},
    BuiltInScene{"strips", "two glowing plates 1 m x 200 m, 1 m apart, reflectance .8",
                 [] { return buildStrips(200.0, 20, 0.8f); }},
    BuiltInScene{"two-rooms", "two furnished rooms and a door, the lamp in one of them", buildTwoRooms},
    BuiltInScene{"lamp-box", "a lamp in a sealed box inside a room: no light may leak out", buildLampBox},
    BuiltInScene{"blobs", "a room with balls that melt into each other: a surface known by its rays alone",
                 buildBlobs},
    BuiltInScene{"building:10000",
                 "a furnished house of 10,000 polygons; building:N has N, building:N:R has R rooms only",
                 [] { return buildBuilding("building:10000"); }},
};

}  // namespace

std::span<const BuiltInScene> builtInScenes() {
    return kScenes;
}

bool isBuiltInScene(std::string_view name) {
    return isBuilding(name) || std::any_of(kScenes.begin(), kScenes.end(),
                                           [name](const BuiltInScene& scene) { return scene.name == name; });
}

std::optional<Scene> buildScene(std::string_view name) {
    if (isBuilding(name)) {
        return buildBuilding(name);
    }
    for (const BuiltInScene& scene : kScenes) {
        if (scene.name == name) {
            return scene.build();
        }
    }
    return std::nullopt;
}

}  // namespace fluxwalk::scene
