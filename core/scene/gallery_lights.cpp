#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/gallery.h"
#include "core/scene/shapes.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"

namespace fluxwalk::scene::gallery {

namespace {

/// Colours of light, about 7,000 K, 3,500 K and 2,800 K, and of a rose tube; their luminance plays no part.
constexpr Rgb kDaylight(0.80f, 1.0f, 1.32f);
constexpr Rgb kNeutral(1.16f, 0.99f, 0.72f);
constexpr Rgb kWarm(1.40f, 0.94f, 0.48f);
constexpr Rgb kRose(1.9f, 0.52f, 1.15f);

// A material that sends so many lumens of a colour from so many square metres.
std::uint32_t addGlow(Scene& scene, std::string name, const Rgb& colour, double lumens, double area) {
    const auto scale = static_cast<float>(lumens / (area * static_cast<double>(base::luminance(colour))));
    return addMaterial(scene, std::move(name), Rgb(0.75f), colour * scale);
}

// A round window in the far wall, in a frame that stands out from it.
void addWindow(Scene& scene, std::uint32_t frame) {
    constexpr double kPane = 0.85;
    constexpr double kFrame = 0.92;
    constexpr double kDepth = 0.08;
    const Vec3d axis(-1.0, 0.0, 0.0);
    const Vec3d onWall(kLength, 3.15, kMiddle);
    const base::Mat4d front = turnTo(axis, onWall + kDepth * axis);
    const std::uint32_t daylight = addGlow(scene, "daylight", kDaylight, 5000.0, base::kPi * kPane * kPane);
    addSurface(scene, "window", daylight, std::make_shared<surface::Disk>(front, kPane));
    addSurface(scene, "window frame", frame, std::make_shared<surface::Disk>(front, kFrame, kPane));
    addSurface(
        scene, "window reveal", frame,
        std::make_shared<surface::Cylinder>(turnTo(axis, onWall + 0.5 * kDepth * axis), kFrame, kDepth));
}

// The tops of the beams, open along their middle.
void addCoves(Scene& scene) {
    constexpr double kHalf = 0.07;
    const std::uint32_t white = addMaterial(scene, "cove", Rgb(0.82f, 0.81f, 0.78f));
    const std::uint32_t glow = addGlow(scene, "cove light", kNeutral, 4500.0, kLength * 2.0 * kHalf);
    for (const double z : {kMiddle - kColonnade, kMiddle + kColonnade}) {
        const auto strip = [&](double from, double to) {
            return boxFaces({0.0, kBeamUnder, z + from}, {kLength, kBeamTop, z + to}, kTop);
        };
        addPolygons(scene, "beam top", white, join({strip(-kBeamHalf, -kHalf), strip(kHalf, kBeamHalf)}));
        addPolygons(scene, "cove light", glow, strip(-kHalf, kHalf));
    }
}

// A shade with a bulb in it, on a cord from the vault.
void addHangingLamp(Scene& scene, const Vec3d& mouth, std::uint32_t bulb, double bulbRadius,
                    std::uint32_t shade, std::uint32_t cord) {
    constexpr double kMouth = 0.20;
    constexpr double kCrown = 0.05;
    constexpr double kHeight = 0.19;
    addCone(scene, "lampshade", shade, mouth, kMouth, kCrown, kHeight);
    addSphere(scene, "bulb", bulb, mouth + Vec3d(0.0, 0.09, 0.0), bulbRadius);
    constexpr double kCord = 0.006;
    // Up to where its far side meets the vault: nothing of it comes out behind.
    const double aside = std::abs(mouth.z - kMiddle) + kCord;
    const double foot = mouth.y + kHeight;
    addCylinder(scene, "cord", cord, {mouth.x, foot, mouth.z}, kCord,
                std::sqrt(kRadius * kRadius - aside * aside) - foot);
}

}  // namespace

void addLights(Scene& scene) {
    const std::uint32_t brass = addMaterial(scene, "brass", {0.62f, 0.46f, 0.22f});
    // Other viewers would otherwise leave out the insides of the shades.
    scene.materials[brass].doubleSided = true;
    const std::uint32_t black = addMaterial(scene, "black", Rgb(0.05f));
    addWindow(scene, brass);
    addCoves(scene);

    constexpr double kBulb = 0.055;
    const std::uint32_t bulb = addGlow(scene, "bulb", kWarm, 1000.0, 4.0 * base::kPi * kBulb * kBulb);
    for (const double x : kPlinthX) {
        addHangingLamp(scene, {x, 2.25, kPlinthZ}, bulb, kBulb, brass, black);
    }

    constexpr double kTube = 0.035;
    constexpr double kTubeHeight = 1.8;
    const Vec3d foot(kLength - 0.35, 0.0, kMiddle - 3.35);
    const std::uint32_t rose = addGlow(scene, "rose", kRose, 1200.0, 2.0 * base::kPi * kTube * kTubeHeight);
    addCylinder(scene, "glowing tube", rose, foot, kTube, kTubeHeight);
    addDisk(scene, "tube cap", black, foot + Vec3d(0.0, kTubeHeight, 0.0), kTube);
}

}  // namespace fluxwalk::scene::gallery
