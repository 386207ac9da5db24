#include <array>

#include "core/scene/gallery.h"
#include "core/scene/shapes.h"

namespace fluxwalk::scene::gallery {

namespace {

constexpr unsigned kSegments = 6;

constexpr std::array<LatheRing, 6> kAmphora{
    {{0.09, 0.0}, {0.13, 0.14}, {0.25, 0.36}, {0.12, 0.52}, {0.065, 0.60}, {0.13, 0.68}}};
constexpr std::array<LatheRing, 6> kBottle{
    {{0.13, 0.0}, {0.20, 0.10}, {0.19, 0.26}, {0.05, 0.36}, {0.045, 0.60}, {0.07, 0.72}}};
constexpr std::array<LatheRing, 5> kBowl{
    {{0.08, 0.0}, {0.07, 0.07}, {0.19, 0.14}, {0.29, 0.26}, {0.30, 0.40}}};

void addVase(Scene& scene, std::string name, const Rgb& glaze, const Vec3d& foot,
             std::span<const LatheRing> rings) {
    const std::uint32_t material = addMaterial(scene, name + " glaze", glaze);
    addSubdivision(scene, std::move(name), material, turnCage(foot, rings, kSegments));
}

void addVases(Scene& scene, std::uint32_t white) {
    constexpr double kHalf = 0.21;
    for (const Vec3d& foot : vaseFeet()) {
        addPolygons(
            scene, "plinth", white,
            boxFaces({foot.x - kHalf, 0.0, foot.z - kHalf}, foot + Vec3d(kHalf, 0.0, kHalf), kStanding));
    }
    addVase(scene, "amphora", {0.64f, 0.22f, 0.11f}, vaseFeet()[0], kAmphora);
    addVase(scene, "bottle", {0.06f, 0.16f, 0.46f}, vaseFeet()[1], kBottle);
    addVase(scene, "bowl", {0.36f, 0.58f, 0.44f}, vaseFeet()[2], kBowl);
}

void addSculptures(Scene& scene, std::uint32_t white) {
    constexpr double kRing = 0.72;
    constexpr double kTube = 0.21;
    constexpr double kDrum = 0.35;
    const Vec3d drum(10.9, 0.0, kMiddle);
    const std::uint32_t stone = addMaterial(scene, "dark stone", Rgb(0.16f, 0.155f, 0.15f));
    const std::uint32_t vermilion = addMaterial(scene, "vermilion", {0.78f, 0.16f, 0.06f});
    addCylinder(scene, "drum", stone, drum, 0.75, kDrum);
    addDisk(scene, "drum top", stone, drum + Vec3d(0.0, kDrum, 0.0), 0.75);
    addStandingTorus(scene, "torus", vermilion, drum + Vec3d(0.0, kDrum + kRing + kTube, 0.0), kRing, kTube,
                     25.0);

    struct Ball {
        const char* name;
        Rgb color;
        Vec3d foot;
        double radius;
    };
    const std::array<Ball, 4> balls{{{"white sphere", {0.86f, 0.85f, 0.83f}, {6.9, 0.0, 3.35}, 0.55},
                                     {"ochre sphere", {0.78f, 0.50f, 0.10f}, {6.05, 0.0, 3.15}, 0.20},
                                     {"blue sphere", {0.10f, 0.24f, 0.60f}, {6.35, 0.0, 4.05}, 0.28},
                                     {"red sphere", {0.70f, 0.10f, 0.09f}, {5.82, 0.0, 3.72}, 0.13}}};
    for (const Ball& ball : balls) {
        const bool isWhite = ball.radius > 0.5;
        const std::uint32_t material =
            isWhite ? white : addMaterial(scene, std::string(ball.name) + " paint", ball.color);
        addSphere(scene, ball.name, material, ball.foot + Vec3d(0.0, ball.radius, 0.0), ball.radius);
    }
}

}  // namespace

const std::array<Vec3d, 3>& vaseFeet() {
    static const std::array<Vec3d, 3> kFeet{
        {{4.6, kVasePlinth, 5.9}, {5.6, kVasePlinth, 5.9}, {8.6, kVasePlinth, 5.9}}};
    return kFeet;
}

void addExhibits(Scene& scene) {
    const std::uint32_t white = addMaterial(scene, "gloss white", {0.85f, 0.84f, 0.82f});
    addVases(scene, white);
    addSculptures(scene, white);
    addPictures(scene);
    addBenches(scene);
}

}  // namespace fluxwalk::scene::gallery
