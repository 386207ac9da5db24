#pragma once

#include <array>

#include "core/scene/polygons.h"

/// Parts of the demo scene `gallery`: a hall of 14 m x 9 m under a barrel vault. x runs from the entrance to
/// the far end, z across; the nave lies between two rows of columns with an aisle on either side.
namespace fluxwalk::scene::gallery {

inline constexpr double kLength = 14.0;
/// Radius of the vault, whose axis lies on the floor.
inline constexpr double kRadius = 4.5;
inline constexpr double kWidth = 2.0 * kRadius;
inline constexpr double kMiddle = kRadius;
/// Distance of the columns from the middle line, and where they stand along it.
inline constexpr double kColonnade = 2.4;
inline constexpr std::array<double, 3> kColumnX{3.5, 7.0, 10.5};
/// Beams on the columns; coves in them send light up to the vault.
inline constexpr double kBeamUnder = 2.85;
inline constexpr double kBeamTop = 3.15;
inline constexpr double kBeamHalf = 0.2;

/// The vases' plinths, below the hanging lamps.
inline constexpr double kPlinthHeight = 0.95;
inline constexpr double kPlinthZ = kMiddle + 1.45;
inline constexpr std::array<double, 3> kPlinthX{4.3, 5.25, 6.2};

/// Floor, vault, end walls, columns and beams.
void addHall(Scene& scene);
/// Window of the far end, coves in the beams, hanging lamps and a glowing tube.
void addLights(Scene& scene);
/// Sculptures, and vases on plinths.
void addExhibits(Scene& scene);
/// Partitions between columns with pictures on them, and benches.
void addFurniture(Scene& scene);

/// Two by two metres of floor: herringbone in oak.
Image drawFloor();
inline constexpr unsigned kPaintings = 4;
/// Picture `number` below kPaintings: 0 and 2 are 4 : 3, the others 3 : 4.
Image drawPainting(unsigned number);

}  // namespace fluxwalk::scene::gallery
