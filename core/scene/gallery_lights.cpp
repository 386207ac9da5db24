#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/gallery.h"
#include "core/scene/shapes.h"

namespace fluxwalk::scene::gallery {

namespace {

constexpr std::array<double, 6> kWasherX{0.0, 1.5, 6.0, 8.0, 12.5, kLength};
constexpr std::array<double, 4> kWasherZ{0.0, 0.6, 0.8, 1.85};

// Cells of both ceilings; the middle row's second and fourth are openings.
Quads ceilingCells(bool openings) {
    Quads cells;
    for (std::size_t i = 0; i + 1 < kWasherX.size(); ++i) {
        for (std::size_t j = 0; j + 1 < kWasherZ.size(); ++j) {
            if ((j == 1 && i % 2 == 1) != openings) {
                continue;
            }
            const auto cell = [&](double z0, double z1) {
                const Quads faces =
                    boxFaces({kWasherX[i], kSpring, z0}, {kWasherX[i + 1], kSpring, z1}, kBottom);
                cells.push_back(faces.front());
            };
            cell(kWasherZ[j], kWasherZ[j + 1]);
            cell(kWidth - kWasherZ[j + 1], kWidth - kWasherZ[j]);
        }
    }
    return cells;
}

double areaOf(const Quads& rectangles) {
    double sum = 0.0;
    for (const Quad& q : rectangles) {
        sum += glm::length(glm::cross(q[1] - q[0], q[3] - q[0]));
    }
    return sum;
}

// A shade with a bulb in its mouth, on a cord from the vault.
void addHangingLamp(Scene& scene, const Vec3d& mouth, std::uint32_t bulb, std::uint32_t shade,
                    std::uint32_t cord) {
    constexpr double kMouth = 0.21;
    constexpr double kCrown = 0.06;
    constexpr double kHeight = 0.20;
    constexpr double kBulbHeight = 0.10;
    addCone(scene, "lampshade", shade, mouth, kMouth, kCrown, kHeight);
    addSphere(scene, "bulb", bulb, mouth + Vec3d(0.0, kBulbHeight, 0.0), kBulbRadius);
    const double top = vaultHeight(std::abs(mouth.z - kMiddle));
    const double foot = mouth.y + kHeight;
    addCylinder(scene, "cord", cord, {mouth.x, foot, mouth.z}, 0.007, top - foot);
}

}  // namespace

std::uint32_t addGlow(Scene& scene, std::string name, const Rgb& colour, double lumens, double area) {
    const Rgb exitance = colour * static_cast<float>(lumens / (area * double{base::luminance(colour)}));
    return addMaterial(scene, std::move(name), Rgb(0.75f), exitance);
}

Quads washerOpenings() {
    return ceilingCells(true);
}

Quads ceilingsAroundWashers() {
    return ceilingCells(false);
}

void addLights(Scene& scene) {
    const Quads openings = washerOpenings();
    addPolygons(scene, "wall washers", addGlow(scene, "washer", kNeutral, 7000.0, areaOf(openings)),
                openings);

    const std::uint32_t brass = addMaterial(scene, "brass", {0.62f, 0.46f, 0.22f});
    const std::uint32_t black = addMaterial(scene, "black", Rgb(0.05f));
    const double bulbArea = 4.0 * base::kPi * kBulbRadius * kBulbRadius;
    const std::uint32_t bulb = addGlow(scene, "bulb", kWarm, 1100.0, bulbArea);
    for (const Vec3d& foot : vaseFeet()) {
        addHangingLamp(scene, {foot.x, 2.35, foot.z}, bulb, brass, black);
    }

    constexpr double kTubeRadius = 0.03;
    constexpr double kTubeHeight = 2.2;
    const std::uint32_t rose =
        addGlow(scene, "rose", kRose, 900.0, 2.0 * base::kPi * kTubeRadius * kTubeHeight);
    addCylinder(scene, "glowing tube", rose, {kLength - 0.4, 0.0, 0.4}, kTubeRadius, kTubeHeight);
    addDisk(scene, "tube cap", black, {kLength - 0.4, kTubeHeight, 0.4}, kTubeRadius);
}

}  // namespace fluxwalk::scene::gallery
