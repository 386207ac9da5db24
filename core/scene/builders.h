#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/scene/scene.h"

/// Built-in scenes as code: one registry for commands, tests and benchmarks.
namespace fluxwalk::scene {

struct BuiltInScene {
    std::string_view name;         ///< as typed by the user, "cornell-box"
    std::string_view description;  ///< one line for `fluxwalk info --list`
    Scene (*build)();
};

std::span<const BuiltInScene> builtInScenes();
/// Whether `buildScene` knows the name; the parameters of a building are not looked at.
bool isBuiltInScene(std::string_view name);
/// Throws base::UsageError where the parameters of a building are out of range.
std::optional<Scene> buildScene(std::string_view name);

/// The Cornell box in metres (geometry published by Cornell University, ALGORITHMS 3.10; y up, the camera
/// looks along +z). The lamp fills a hole of the ceiling and has `lampExitance` in lm/m2. Objects, in this
/// order: floor, ceiling, back wall, right wall (green), left wall (red), short block, tall block, lamp. A
/// block's patches: top, then its four sides; it has no bottom.
Scene buildCornellBox(const Rgb& lampExitance);

/// Closed room of the Cornell box with its two blocks and, if asked for, a sphere that floats: every surface
/// has the same reflectance and emits 1 lm/m2, so that B = 1 / (1 - reflectance) at every point. The blocks
/// emit inwards too, as the floor under them does.
Scene buildFurnace(float reflectance, bool withSphere);

/// Two unit squares that face each other at `gap` metres. Objects: source (emits 1 lm/m2), receiver. Without
/// reflection the receiver's mean irradiance is the form factor.
Scene buildParallelSquares(double gap, float reflectance = 0.0f);

/// Two unit squares that share an edge and include `degrees`. Objects: source (emits 1 lm/m2), receiver.
Scene buildWedge(double degrees, float reflectance = 0.0f);

/// CIE 171:2006 test 5.8: a cube of 4 m with an isotropic point source of 10,000 lm in its centre.
Scene buildCie58(float reflectance);

/// Two parallel plates, 1 m wide and 1 m apart, that face each other and emit 1 lm/m2; each consists of
/// `segments` patches along its `length` in metres. They stand for infinite strips.
Scene buildStrips(double length, unsigned segments, float reflectance);

/// Two furnished rooms with a door between them; the lamp hangs in the first.
Scene buildTwoRooms();

/// A lamp in a sealed box of zero wall thickness that hangs in a room: nothing outside may be lit. Objects:
/// room, box, lamp.
Scene buildLampBox();

/// A closed room with a lamp and a sculpture, a smooth union of balls on a plinth: an object that can only
/// meet rays. Objects: room, lamp, plinth, sculpture.
Scene buildBlobs();

/// Whether a name asks for a building: "building:N" or "building:N:R".
bool isBuilding(std::string_view name);
/// A furnished house of several storeys with about N polygons (within 10 %), 10,000 to 2,000,000. As
/// "building:N" it has as many rooms of the coarsest furniture as that takes; as "building:N:R" it has R
/// rooms (at most N / 1150), the first R of a larger building with the same plan, and furniture as fine as
/// that takes. Rooms lie on both sides of a corridor with stairs at its beginning; every room has a door that
/// stands open or is closed, a window with dark panes, furniture and lamps of 2,850 to 5,750 lm. Closed;
/// every mesh is closed, save that a lamp's panel closes the housing before it. Throws base::UsageError where
/// the numbers are out of range.
Scene buildBuilding(std::string_view name);

/// The demo: an exhibition hall with every curved shape in it, daylight at its end and lamps.
Scene buildGallery();

}  // namespace fluxwalk::scene
