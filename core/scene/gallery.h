#pragma once

#include <array>

#include "core/scene/polygons.h"

/// Parts of the demo scene `gallery`: a vaulted hall of 14 m x 9 m. x runs from the entrance to the far end,
/// z across; the nave lies between two rows of columns with an aisle on either side.
namespace fluxwalk::scene::gallery {

inline constexpr double kLength = 14.0;
inline constexpr double kWidth = 9.0;
inline constexpr double kMiddle = 0.5 * kWidth;
/// Ceiling of the aisles, from which the vault springs.
inline constexpr double kSpring = 3.5;
/// The nave: between the inner faces of the beams that carry the vault.
inline constexpr double kNaveNear = 2.25;
inline constexpr double kNaveFar = kWidth - kNaveNear;
/// Rise of the vault above its springing.
inline constexpr double kRise = 2.0;

/// Height of the vault above the floor at a distance from the hall's middle line.
double vaultHeight(double distance);

/// Ceilings of the aisles: the openings of the wall washers, or all around them.
Quads washerOpenings();
Quads ceilingsAroundWashers();

/// Colours of light, about 7,000 K, 3,500 K and 2,800 K, and of a rose tube; their luminance plays no part.
inline constexpr Rgb kDaylight(0.80f, 1.0f, 1.32f);
inline constexpr Rgb kNeutral(1.16f, 0.99f, 0.72f);
inline constexpr Rgb kWarm(1.40f, 0.94f, 0.48f);
inline constexpr Rgb kRose(1.9f, 0.52f, 1.15f);

/// A material that sends so many lumens of a colour from so many square metres.
std::uint32_t addGlow(Scene& scene, std::string name, const Rgb& colour, double lumens, double area);

/// Walls, floor, ceilings, vault, columns, and daylight at the far end.
void addHall(Scene& scene);
/// Wall washers, hanging lamps and a glowing tube.
void addLights(Scene& scene);
/// Sculptures, vases on plinths, pictures and benches.
void addExhibits(Scene& scene);

void addPictures(Scene& scene);
void addBenches(Scene& scene);

/// Two by two metres of floor: herringbone in oak.
Image drawFloor();
/// The four pictures on the walls.
Image drawPainting(unsigned number);
inline constexpr unsigned kPaintings = 4;

/// Where the vases stand, and above them the lamps hang.
inline constexpr double kVasePlinth = 0.95;
inline constexpr double kBulbRadius = 0.055;
const std::array<Vec3d, 3>& vaseFeet();

}  // namespace fluxwalk::scene::gallery
