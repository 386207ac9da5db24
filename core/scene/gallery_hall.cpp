#include <array>
#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/gallery.h"
#include "core/scene/polygons.h"
#include "core/scene/shapes.h"

namespace fluxwalk::scene::gallery {

namespace {

/// Beams on the columns.
constexpr double kBeamNear = 1.85;
constexpr double kBeamUnder = 3.1;

constexpr unsigned kArchParts = 4;

// Control points of the vault's cross-section, from one springing to the other: on an ellipse, widened so
// that the cubic B-spline comes to lie on it.
std::array<Vec3d, kArchParts + 1> archPoints(double x) {
    constexpr double kStep = base::kPi / kArchParts;
    const double growth = 6.0 / (4.0 + 2.0 * std::cos(kStep));
    std::array<Vec3d, kArchParts + 1> points{};
    for (unsigned i = 0; i <= kArchParts; ++i) {
        const bool isEnd = i == 0 || i == kArchParts;
        const double g = isEnd ? 1.0 : growth;
        points[i] = {x, kSpring + g * kRise * std::sin(i * kStep),
                     kMiddle - g * (kMiddle - kNaveNear) * std::cos(i * kStep)};
    }
    points[0] = {x, kSpring, kNaveNear};
    points[kArchParts] = {x, kSpring, kNaveFar};
    return points;
}

void addFace(surface::ControlCage& cage, std::array<std::uint32_t, 4> corners, bool reversed = false) {
    if (reversed) {
        std::swap(corners[1], corners[3]);
    }
    cage.faceSizes.push_back(4);
    cage.corners.insert(cage.corners.end(), corners.begin(), corners.end());
}

surface::ControlCage vaultCage() {
    constexpr unsigned kAlong = 4;
    surface::ControlCage cage;
    for (unsigned j = 0; j <= kAlong; ++j) {
        const auto arch = archPoints(kLength * j / kAlong);
        cage.positions.insert(cage.positions.end(), arch.begin(), arch.end());
    }
    constexpr std::uint32_t kRow = kArchParts + 1;
    for (std::uint32_t j = 0; j < kAlong; ++j) {
        for (std::uint32_t i = 0; i < kArchParts; ++i) {
            const std::uint32_t at = j * kRow + i;
            addFace(cage, {at, at + kRow, at + kRow + 1, at + 1});
        }
    }
    return cage;
}

// The wall under the vault's end, bounded by the same B-spline: six quads about three inner points.
surface::ControlCage lunetteCage(double x, bool facesMinusX) {
    surface::ControlCage cage;
    const auto arch = archPoints(x);
    cage.positions.assign(arch.begin(), arch.end());
    const double half = 0.5 * (kMiddle - kNaveNear);
    for (const double z : {kMiddle - half, kMiddle, kMiddle + half}) {
        cage.positions.emplace_back(x, kSpring, z);
    }
    for (const double z : {kMiddle - half, kMiddle, kMiddle + half}) {
        cage.positions.emplace_back(x, kSpring + (z == kMiddle ? 0.55 : 0.5) * kRise, z);
    }
    // Arch 0..4, foot 5..7, inside 8..10; seen from +x, z runs to the left.
    const std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 1, 8, 5}, {1, 2, 9, 8}, {2, 3, 10, 9}, {3, 4, 7, 10}, {5, 8, 9, 6}, {6, 9, 10, 7}}};
    for (const auto& face : faces) {
        addFace(cage, face, facesMinusX);
    }
    return cage;
}

void addShell(Scene& scene) {
    const std::uint32_t plaster = addMaterial(scene, "plaster", {0.80f, 0.78f, 0.74f});
    const std::uint32_t white = addMaterial(scene, "white plaster", {0.84f, 0.83f, 0.81f});
    const std::uint32_t petrol = addMaterial(scene, "petrol plaster", {0.10f, 0.25f, 0.30f});
    const std::uint32_t oak = addMaterial(scene, "oak floor", Rgb(0.95f));
    scene.images.push_back(drawFloor());
    scene.materials[oak].reflectanceTexture.image = static_cast<std::int32_t>(scene.images.size() - 1);

    const Vec3d upper(kLength, kSpring, kWidth);
    addTexturedPolygons(scene, "floor", oak, boxFaces(Vec3d(0.0), upper, kBottom, true),
                        [](const Vec3d& p) { return base::Vec2(0.5 * p.x, 0.5 * p.z); });
    addPolygons(scene, "side walls", plaster, boxFaces(Vec3d(0.0), upper, kNear | kFar, true));
    addPolygons(scene, "entrance wall", plaster, boxFaces(Vec3d(0.0), upper, kLeft, true));
    addPolygons(scene, "far wall", petrol, boxFaces(Vec3d(0.0), upper, kRight, true));
    addPolygons(scene, "aisle ceilings", white, ceilingsAroundWashers());
    for (const double z : {kBeamNear, kWidth - kNaveNear}) {
        addPolygons(scene, "beam", white,
                    boxFaces({0.0, kBeamUnder, z}, {kLength, kSpring, z + kNaveNear - kBeamNear},
                             kNear | kFar | kBottom));
    }
    addSubdivision(scene, "vault", white, vaultCage());
    addSubdivision(scene, "entrance lunette", white, lunetteCage(0.0, false));
    addSubdivision(scene, "window", addGlow(scene, "daylight", kDaylight, 6000.0, 7.1),
                   lunetteCage(kLength, true));
}

// Plinth, base, shaft and capital touch along circles where patches end: the rings of base and capital lie
// against the shaft and on what is below or above them.
void addColumn(Scene& scene, double x, double z, std::uint32_t stone) {
    constexpr double kShaft = 0.17;
    constexpr double kBase = 0.065;
    constexpr double kNeck = 0.045;
    constexpr double kPlinthRadius = 0.32;
    constexpr double kPlinthHeight = 0.13;
    constexpr double kAbacus = 0.11;
    constexpr double kAbacusHalf = 0.29;
    const double top = kBeamUnder - kAbacus;
    const double shaftFoot = kPlinthHeight + kBase;
    addCylinder(scene, "column plinth", stone, {x, 0.0, z}, kPlinthRadius, kPlinthHeight);
    addDisk(scene, "column step", stone, {x, kPlinthHeight, z}, kPlinthRadius, kShaft + kBase);
    addTorus(scene, "column base", stone, {x, shaftFoot, z}, kShaft + kBase, kBase);
    addCylinder(scene, "column shaft", stone, {x, shaftFoot, z}, kShaft, top - kNeck - shaftFoot);
    addTorus(scene, "column neck", stone, {x, top - kNeck, z}, kShaft + kNeck, kNeck);
    addPolygons(scene, "abacus", stone,
                boxFaces({x - kAbacusHalf, top, z - kAbacusHalf},
                         {x + kAbacusHalf, kBeamUnder, z + kAbacusHalf}, kAround | kBottom | kTop));
}

}  // namespace

double vaultHeight(double distance) {
    const double part = distance / (kMiddle - kNaveNear);
    return kSpring + kRise * std::sqrt(1.0 - part * part);
}

void addHall(Scene& scene) {
    addShell(scene);
    const std::uint32_t stone = addMaterial(scene, "limestone", {0.72f, 0.67f, 0.58f});
    const double inset = 0.5 * (kBeamNear + kNaveNear);
    for (const double z : {inset, kWidth - inset}) {
        for (const double x : {3.5, 7.0, 10.5}) {
            addColumn(scene, x, z, stone);
        }
    }
}

}  // namespace fluxwalk::scene::gallery
