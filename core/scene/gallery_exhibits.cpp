#include <array>
#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/gallery.h"
#include "core/scene/shapes.h"
#include "core/surface/affine_map.h"
#include "core/surface/sphere.h"
#include "core/surface/torus.h"

namespace fluxwalk::scene::gallery {

namespace {

constexpr unsigned kSegments = 6;

constexpr std::array<LatheRing, 5> kAmphora{
    {{0.075, 0.0}, {0.17, 0.20}, {0.26, 0.42}, {0.05, 0.55}, {0.12, 0.68}}};
constexpr std::array<LatheRing, 5> kBottle{
    {{0.12, 0.0}, {0.235, 0.10}, {0.15, 0.32}, {0.02, 0.42}, {0.06, 0.75}}};
constexpr std::array<LatheRing, 4> kBowl{{{0.09, 0.0}, {0.06, 0.08}, {0.28, 0.18}, {0.27, 0.42}}};

// Vessels without a bottom stand on their plinths. Two have lids into which their rims reach, so that no
// light gets in.
void addVases(Scene& scene, std::uint32_t white) {
    constexpr double kHalf = 0.2;
    for (const double x : kPlinthX) {
        addPolygons(scene, "plinth", white,
                    boxFaces({x - kHalf, 0.0, kPlinthZ - kHalf}, {x + kHalf, kPlinthHeight, kPlinthZ + kHalf},
                             kStanding));
    }
    struct Vase {
        const char* name;
        Rgb glaze;
        std::span<const LatheRing> rings;
    };
    const std::array<Vase, 3> vases{{{"amphora", {0.66f, 0.24f, 0.11f}, kAmphora},
                                     {"bottle", {0.07f, 0.18f, 0.50f}, kBottle},
                                     {"bowl", {0.40f, 0.62f, 0.46f}, kBowl}}};
    for (std::size_t i = 0; i < vases.size(); ++i) {
        const std::uint32_t glaze = addMaterial(scene, vases[i].name + std::string(" glaze"), vases[i].glaze);
        scene.materials[glaze].doubleSided = true;
        addSubdivision(scene, vases[i].name, glaze,
                       turnCage({kPlinthX[i], kPlinthHeight, kPlinthZ}, vases[i].rings, kSegments));
    }
    const std::uint32_t lid = addMaterial(scene, "lid glaze", {0.10f, 0.09f, 0.09f});
    const auto addLid = [&](std::size_t vase, const Vec3d& half, double sunk) {
        const double rim = kPlinthHeight + vases[vase].rings.back().height;
        const base::Mat4d place = turnTo({0.0, 0.0, 1.0}, {kPlinthX[vase], rim + half.y - sunk, kPlinthZ});
        addSurface(scene, vases[vase].name + std::string(" lid"), lid,
                   std::make_shared<surface::Sphere>(surface::scaledMap(place, {half.y, half.z, half.x})));
    };
    addLid(0, {0.15, 0.045, 0.15}, 0.035);
    addLid(1, {0.085, 0.085, 0.085}, 0.05);
}

void addTorusOnDrum(Scene& scene) {
    constexpr double kRing = 0.70;
    constexpr double kTube = 0.21;
    constexpr double kDrumRadius = 0.72;
    constexpr double kDrum = 0.32;
    const Vec3d drum(11.2, 0.0, kMiddle);
    const std::uint32_t stone = addMaterial(scene, "dark stone", {0.16f, 0.155f, 0.15f});
    const std::uint32_t vermilion = addMaterial(scene, "vermilion", {0.80f, 0.17f, 0.06f});
    addCylinder(scene, "drum", stone, drum, kDrumRadius, kDrum);
    addDisk(scene, "drum top", stone, drum + Vec3d(0.0, kDrum, 0.0), kDrumRadius);
    constexpr double kTurn = 28.0 * base::kPi / 180.0;
    const Vec3d axis(std::cos(kTurn), 0.0, std::sin(kTurn));
    addSurface(scene, "torus", vermilion,
               std::make_shared<surface::Torus>(turnTo(axis, drum + Vec3d(0.0, kDrum + kRing + kTube, 0.0)),
                                                kRing, kTube));
}

void addSpheres(Scene& scene, std::uint32_t white) {
    struct Ball {
        const char* name;
        Rgb paint;
        double x;
        double z;
        double radius;
    };
    const std::array<Ball, 3> balls{{{"ochre sphere", {0.78f, 0.50f, 0.10f}, 6.35, 3.05, 0.20},
                                     {"blue sphere", {0.10f, 0.24f, 0.60f}, 6.62, 4.08, 0.28},
                                     {"red sphere", {0.70f, 0.10f, 0.09f}, 6.10, 3.72, 0.13}}};
    addSphere(scene, "white sphere", white, {7.3, 0.55, 3.4}, 0.55);
    for (const Ball& ball : balls) {
        addSphere(scene, ball.name, addMaterial(scene, ball.name, ball.paint), {ball.x, ball.radius, ball.z},
                  ball.radius);
    }
}

}  // namespace

void addExhibits(Scene& scene) {
    const std::uint32_t white = addMaterial(scene, "matt white", {0.85f, 0.84f, 0.82f});
    addVases(scene, white);
    addTorusOnDrum(scene);
    addSpheres(scene, white);
}

}  // namespace fluxwalk::scene::gallery
