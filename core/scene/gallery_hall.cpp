#include "core/scene/gallery.h"
#include "core/scene/shapes.h"
#include "core/surface/cylinder.h"
#include "core/surface/disk.h"

namespace fluxwalk::scene::gallery {

namespace {

// The vault is a whole cylinder and its ends whole disks, quartered by the floor: light reaches their upper
// patches only.
void addShell(Scene& scene, std::uint32_t white) {
    const std::uint32_t petrol = addMaterial(scene, "petrol plaster", {0.11f, 0.27f, 0.32f});
    const std::uint32_t oak = addMaterial(scene, "oak floor", Rgb(0.95f));
    scene.images.push_back(drawFloor());
    scene.materials[oak].reflectanceTexture.image = static_cast<std::int32_t>(scene.images.size() - 1);
    addTexturedPolygons(scene, "floor", oak, boxFaces(Vec3d(0.0), {kLength, kRadius, kWidth}, kBottom, true),
                        [](const Vec3d& p) { return base::Vec2(0.5 * p.x, 0.5 * p.z); });

    const Vec3d ahead(1.0, 0.0, 0.0);
    const Vec3d entrance(0.0, 0.0, kMiddle);
    const Vec3d end(kLength, 0.0, kMiddle);
    addSurface(
        scene, "vault", white,
        std::make_shared<surface::Cylinder>(turnTo(ahead, 0.5 * (entrance + end)), kRadius, kLength, true));
    addSurface(scene, "entrance wall", white,
               std::make_shared<surface::Disk>(turnTo(ahead, entrance), kRadius));
    addSurface(scene, "far wall", petrol, std::make_shared<surface::Disk>(turnTo(-ahead, end), kRadius));
}

// The parts touch along circles at which patches end: the shaft stands on the crest of the base's ring, which
// lies on the step.
void addColumn(Scene& scene, double x, double z, std::uint32_t stone) {
    constexpr double kShaft = 0.16;
    constexpr double kRing = 0.07;
    constexpr double kStepRadius = 0.27;
    constexpr double kStep = 0.12;
    constexpr double kAbacus = 0.10;
    constexpr double kAbacusHalf = 0.27;
    constexpr double kEchinus = 0.12;
    const double abacusUnder = kBeamUnder - kAbacus;
    const double shaftFoot = kStep + 2.0 * kRing;
    addCylinder(scene, "column step", stone, {x, 0.0, z}, kStepRadius, kStep);
    addDisk(scene, "column step top", stone, {x, kStep, z}, kStepRadius, kShaft);
    addTorus(scene, "column base", stone, {x, kStep + kRing, z}, kShaft, kRing);
    addCylinder(scene, "column shaft", stone, {x, shaftFoot, z}, kShaft, abacusUnder - kEchinus - shaftFoot);
    addCone(scene, "column echinus", stone, {x, abacusUnder - kEchinus, z}, kShaft, kAbacusHalf, kEchinus);
    addPolygons(scene, "column abacus", stone,
                boxFaces({x - kAbacusHalf, abacusUnder, z - kAbacusHalf},
                         {x + kAbacusHalf, kBeamUnder, z + kAbacusHalf}));
}

}  // namespace

void addHall(Scene& scene) {
    const std::uint32_t white = addMaterial(scene, "white plaster", {0.82f, 0.81f, 0.78f});
    addShell(scene, white);
    const std::uint32_t stone = addMaterial(scene, "limestone", {0.72f, 0.67f, 0.58f});
    for (const double z : {kMiddle - kColonnade, kMiddle + kColonnade}) {
        addPolygons(scene, "beam", white,
                    boxFaces({0.0, kBeamUnder, z - kBeamHalf}, {kLength, kBeamTop, z + kBeamHalf},
                             kNear | kFar | kBottom));
        for (const double x : kColumnX) {
            addColumn(scene, x, z, stone);
        }
    }
}

}  // namespace fluxwalk::scene::gallery
