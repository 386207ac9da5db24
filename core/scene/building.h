#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/scene/building_solids.h"

/// Parts of the built-in scene `building`. A room's coordinates: x along the corridor, z from the corridor's
/// wall to the windows, y = 0 on its floor.
namespace fluxwalk::scene::building {

/// Sizes of the structure in metres, all of them exact in binary: what touches, touches exactly.
inline constexpr double kHalfWall = 0.0625;  ///< each of two rooms has its half of the wall between them
inline constexpr double kFacade = 0.3125;
inline constexpr double kFloorPlate = 0.03125;
inline constexpr double kClearHeight = 2.75;
inline constexpr double kSlab = 0.34375;
inline constexpr double kStorey = kFloorPlate + kClearHeight + kSlab;
inline constexpr double kRoomDepth = 5.25;
inline constexpr double kCorridorWidth = 2.0;
inline constexpr double kDoorHeight = 2.125;
inline constexpr double kDoorFrom = 0.5;  ///< of the opening along a room's wall
inline constexpr double kDoorTo = 1.5;

/// How fine the furniture is: 1 is the coarsest.
struct Detail {
    double level = 1.0;

    /// A number that grows from `base` with a power of the level, at most `most`.
    unsigned grow(unsigned base, double power = 1.0, unsigned most = 100000) const;
};

/// Indices of the scene's materials.
struct Palette {
    std::array<std::uint32_t, 6> walls{};
    std::array<std::uint32_t, 5> floors{};
    std::array<std::uint32_t, 4> woods{};
    std::array<std::uint32_t, 6> cloths{};
    std::array<std::uint32_t, 8> colours{};
    std::uint32_t white = 0;
    std::uint32_t concrete = 0;
    std::uint32_t stone = 0;
    std::uint32_t metal = 0;
    std::uint32_t steel = 0;
    std::uint32_t black = 0;
    std::uint32_t pane = 0;
    std::uint32_t paper = 0;
    std::uint32_t leaf = 0;
    std::uint32_t clay = 0;
    std::uint32_t shade = 0;
    std::uint32_t panelLight = 0;  ///< lm/m2 of a panel of kPanelLumens
    std::uint32_t bulbLight = 0;
    std::uint32_t globeLight = 0;
};
Palette addPalette(Scene& scene);

/// Light of the lamps in lm; a room has 2,850 to 5,750 in all.
inline constexpr double kPanelLumens = 2400.0;
inline constexpr double kBulbLumens = 950.0;
inline constexpr double kGlobeLumens = 2600.0;
inline constexpr double kPanelLength = 1.2;
inline constexpr double kPanelWidth = 0.3;
inline constexpr double kBulbRadius = 0.05;
inline constexpr double kGlobeRadius = 0.16;

/// What every part needs to be made.
struct Workshop {
    SolidMaker solids;
    Palette palette;
    Detail detail;
};

/// An opening in a wall, from and to along it, bottom and top above the floor.
struct Opening {
    double from = 0.0;
    double to = 0.0;
    double bottom = 0.0;
    double top = 0.0;
};

/// A box of space with its floor plate, walls and ceiling; openings in the order of their place.
struct Cell {
    double width = 0.0;  ///< along x, between the walls
    double depth = 0.0;  ///< along z
    /// Thickness of the walls at x = 0, x = width, z = 0, z = depth; 0 for no wall.
    std::array<double, 4> thickness{};
    std::array<std::vector<Opening>, 4> openings;
    std::uint32_t floor = 0;
    std::uint32_t walls = 0;
};
void addCell(Workshop& w, const Placement& at, const Cell& cell);
void addWalls(Workshop& w, const Placement& at, const Cell& cell, double bottom, double top);

/// Lining, leaf and sill of the door in a room's wall at z = 0; it stands open by `degrees` into the room.
void addDoor(Workshop& w, const Placement& at, double degrees, std::uint32_t wood);
/// Frame, panes and board of a window in the wall at z = kRoomDepth.
void addWindow(Workshop& w, const Placement& at, const Opening& opening);

/// Well with two flights up to the next storey, which it has unless it is the last. Its cell's coordinates
/// are a room's, the corridor's wall is open at `door`.
struct StairHall {
    double width = 0.0;
    std::array<double, 4> thickness{};
    Opening door;
    bool isFirst = false;
    bool isLast = false;
};
void addStairHall(Workshop& w, const Placement& at, const StairHall& hall);

enum class RoomKind : std::uint8_t { office, meeting, living, bedroom, kitchen };
inline constexpr unsigned kRoomKinds = 5;

struct Room {
    RoomKind kind = RoomKind::office;
    double width = 0.0;
    std::uint64_t key = 0;  ///< of everything random in it
};
/// Furniture, lamps and what hangs on the walls.
void furnish(Workshop& w, const Placement& at, const Room& room, const Opening& window);

/// The storeys' plan. Rooms lie on both sides of a corridor; the first bay of one side is the stair well.
struct Plan {
    unsigned rooms = 0;
    unsigned storeys = 0;
    std::vector<double> bays;  ///< widths along the corridor

    unsigned roomsPerStorey() const { return static_cast<unsigned>(2 * bays.size() - 1); }
};
Plan planStoreys(unsigned rooms);
/// Makes everything of a building; returns the number of patches.
std::size_t construct(Scene* scene, const Plan& plan, const Palette& palette, Detail detail);
void addCameras(Scene& scene, const Plan& plan);

}  // namespace fluxwalk::scene::building
