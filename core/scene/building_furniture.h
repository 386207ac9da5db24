#pragma once

#include "core/scene/building.h"

/// Furniture of the built-in scene `building`: each piece stands on y = 0 of its placement, its front towards
/// +z and its middle on the origin unless said otherwise. Sizes in metres.
namespace fluxwalk::scene::building {

/// Turned or square legs at the corners of a plan, up to `height`.
void addLegs(Workshop& w, double halfX, double halfZ, double height, double thickness);

void addTable(Workshop& w, const Placement& at, const Vec3d& size, std::uint32_t wood);
/// Round top on one exact column and a foot.
void addRoundTable(Workshop& w, const Placement& at, double radius, double height, std::uint32_t wood);
void addChair(Workshop& w, const Placement& at, std::uint32_t wood, std::uint32_t cloth);
void addOfficeChair(Workshop& w, const Placement& at, std::uint32_t cloth);
/// Back at z = 0, front at z = depth.
void addSofa(Workshop& w, const Placement& at, double width, std::uint32_t cloth, std::uint64_t key);
/// Head at z = 0.
void addBed(Workshop& w, const Placement& at, std::uint32_t wood, std::uint32_t cloth);
/// Back at z = 0.
void addWardrobe(Workshop& w, const Placement& at, double width, std::uint32_t wood);
/// Back at z = 0; books and other things on its boards.
void addBookcase(Workshop& w, const Placement& at, double width, unsigned boards, std::uint32_t wood,
                 std::uint64_t key);
/// Cupboards under a worktop along x, back at z = 0, and others on the wall above.
void addKitchenCounter(Workshop& w, const Placement& at, double width, std::uint32_t wood, std::uint64_t key);
void addRug(Workshop& w, const Placement& at, double width, double depth, std::uint32_t cloth);

/// Things: on a table, a board or the floor at y = 0.
void addScreen(Workshop& w, const Placement& at, double width);
void addKeyboard(Workshop& w, const Placement& at);
void addMug(Workshop& w, const Placement& at, std::uint32_t colour);
void addBowl(Workshop& w, const Placement& at, double radius, std::uint32_t colour);
void addBottle(Workshop& w, const Placement& at, double height, std::uint32_t colour);
void addPaper(Workshop& w, const Placement& at);
void addPlant(Workshop& w, const Placement& at, double height, std::uint64_t key);
void addBin(Workshop& w, const Placement& at);
/// A row of standing books between two places along x, backs at z = 0.
void addBooks(Workshop& w, const Placement& at, double from, double to, double room, std::uint64_t key);
/// On the wall behind z = 0, its middle at y = 0.
void addPicture(Workshop& w, const Placement& at, double width, double height, std::uint32_t colour);

/// Fittings of a room's window.
void addRadiator(Workshop& w, const Placement& at, double width);
void addBlinds(Workshop& w, const Placement& at, const Opening& window, double part);
void addCurtains(Workshop& w, const Placement& at, const Opening& window, std::uint32_t cloth);

/// Lamps: a panel under a ceiling at y = 0, a globe or a shade that hangs from there, and shades on a stand.
void addPanel(Workshop& w, const Placement& at);
void addGlobe(Workshop& w, const Placement& at, double cord);
void addPendant(Workshop& w, const Placement& at, double cord);
void addStandLamp(Workshop& w, const Placement& at, double height);

}  // namespace fluxwalk::scene::building
