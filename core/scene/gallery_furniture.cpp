#include "core/scene/gallery.h"

namespace fluxwalk::scene::gallery {

namespace {

constexpr double kPartitionHeight = 2.35;
constexpr double kPartitionHalf = 0.07;
constexpr double kEyeLine = 1.5;

// A wall of 2.3 m between two columns; returns the z of the side that faces the nave.
double addPartition(Scene& scene, double x, bool isFar, std::uint32_t material) {
    constexpr double kHalfLength = 1.15;
    const double z = isFar ? kMiddle + kColonnade : kMiddle - kColonnade;
    addPolygons(scene, "partition", material,
                boxFaces({x - kHalfLength, 0.0, z - kPartitionHalf},
                         {x + kHalfLength, kPartitionHeight, z + kPartitionHalf}, kStanding));
    return isFar ? z - kPartitionHalf : z + kPartitionHalf;
}

// A picture on a wall that faces the nave.
void addPicture(Scene& scene, double x, double wall, bool isFar, const base::Vec2d& size, std::uint32_t frame,
                std::uint32_t canvas) {
    constexpr double kDepth = 0.04;
    const double front = isFar ? wall - kDepth : wall + kDepth;
    const Vec3d lower(x - 0.5 * size.x, kEyeLine - 0.5 * size.y, std::min(wall, front));
    const Vec3d upper(x + 0.5 * size.x, kEyeLine + 0.5 * size.y, std::max(wall, front));
    addPolygons(scene, "picture frame", frame, boxFaces(lower, upper, kLeft | kRight | kBottom | kTop));
    addTexturedPolygons(scene, "picture", canvas, boxFaces(lower, upper, isFar ? kNear : kFar),
                        [&](const Vec3d& p) {
                            const double part = (p.x - lower.x) / size.x;
                            return base::Vec2(isFar ? 1.0 - part : part, (upper.y - p.y) / size.y);
                        });
}

// Seat on two blocks, along the nave.
void addBench(Scene& scene, const Vec3d& corner, std::uint32_t wood, std::uint32_t dark) {
    constexpr double kSeat = 0.07;
    constexpr double kInset = 0.22;
    constexpr double kLeg = 0.08;
    const Vec3d upper = corner + Vec3d(1.6, 0.45, 0.45);
    const double under = upper.y - kSeat;
    addPolygons(scene, "bench", wood, boxFaces({corner.x, under, corner.z}, upper));
    for (const double x : {corner.x + kInset, upper.x - kInset - kLeg}) {
        addPolygons(scene, "bench leg", dark,
                    boxFaces({x, corner.y, corner.z + 0.06}, {x + kLeg, under, upper.z - 0.06}, kAround));
    }
}

}  // namespace

void addFurniture(Scene& scene) {
    const std::uint32_t plaster = addMaterial(scene, "partition plaster", {0.80f, 0.78f, 0.74f});
    const std::uint32_t petrol = addMaterial(scene, "partition petrol", {0.11f, 0.27f, 0.32f});
    const std::uint32_t frame = addMaterial(scene, "picture frame", {0.09f, 0.07f, 0.055f});
    std::array<std::uint32_t, kPaintings> canvases{};
    for (unsigned i = 0; i < kPaintings; ++i) {
        canvases[i] = addMaterial(scene, "canvas " + std::to_string(i + 1), Rgb(0.95f));
        scene.images.push_back(drawPainting(i));
        scene.materials[canvases[i]].reflectanceTexture.image =
            static_cast<std::int32_t>(scene.images.size() - 1);
    }
    const base::Vec2d wide(1.52, 1.14);
    const base::Vec2d tall(0.99, 1.32);
    const double firstBay = 0.5 * (kColumnX[0] + kColumnX[1]);
    const double secondBay = 0.5 * (kColumnX[1] + kColumnX[2]);
    const double nearWall = addPartition(scene, firstBay, false, plaster);
    addPicture(scene, firstBay, nearWall, false, wide, frame, canvases[0]);
    addPartition(scene, secondBay, false, plaster);
    addPicture(scene, secondBay - 0.55, nearWall, false, tall * 0.85, frame, canvases[1]);
    addPicture(scene, secondBay + 0.55, nearWall, false, tall * 0.85, frame, canvases[3]);
    addPartition(scene, firstBay, true, petrol);
    const double farWall = addPartition(scene, secondBay, true, plaster);
    addPicture(scene, secondBay, farWall, true, wide, frame, canvases[2]);

    const std::uint32_t wood = addMaterial(scene, "walnut", {0.30f, 0.18f, 0.10f});
    const std::uint32_t dark = addMaterial(scene, "bronze", {0.12f, 0.10f, 0.08f});
    addBench(scene, {1.9, 0.0, kMiddle - 1.9}, wood, dark);
    addBench(scene, {8.3, 0.0, kMiddle + 0.9}, wood, dark);
}

}  // namespace fluxwalk::scene::gallery
