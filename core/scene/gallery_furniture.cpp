#include "core/scene/gallery.h"

namespace fluxwalk::scene::gallery {

namespace {

constexpr double kPictureDepth = 0.05;

/// A picture on a side wall: middle along the wall, and size. The colours run from left to right and from
/// above.
struct Hanging {
    double x = 0.0;
    double width = 0.0;
    double height = 0.0;
    bool isFar = false;  ///< on the wall at z = kWidth
    unsigned painting = 0;
};

constexpr double kEyeLine = 1.6;

void addPicture(Scene& scene, const Hanging& hanging, std::uint32_t frame, std::uint32_t canvas) {
    const double wall = hanging.isFar ? kWidth : 0.0;
    const double front = hanging.isFar ? kWidth - kPictureDepth : kPictureDepth;
    const Vec3d lower(hanging.x - 0.5 * hanging.width, kEyeLine - 0.5 * hanging.height,
                      std::min(wall, front));
    const Vec3d upper(hanging.x + 0.5 * hanging.width, kEyeLine + 0.5 * hanging.height,
                      std::max(wall, front));
    addPolygons(scene, "picture frame", frame, boxFaces(lower, upper, kLeft | kRight | kBottom | kTop));
    const Quads face = boxFaces(lower, upper, hanging.isFar ? kNear : kFar);
    addTexturedPolygons(scene, "picture", canvas, face, [&](const Vec3d& p) {
        const double along = (p.x - lower.x) / hanging.width;
        return base::Vec2(hanging.isFar ? 1.0 - along : along, (upper.y - p.y) / hanging.height);
    });
}

// Seat on two blocks.
void addBench(Scene& scene, const Vec3d& corner, const Vec3d& size, std::uint32_t wood, std::uint32_t dark) {
    constexpr double kSeat = 0.07;
    constexpr double kInset = 0.25;
    constexpr double kLeg = 0.08;
    const Vec3d upper = corner + size;
    const double under = upper.y - kSeat;
    addPolygons(scene, "bench", wood, boxFaces({corner.x, under, corner.z}, upper));
    for (const double x : {corner.x + kInset, upper.x - kInset - kLeg}) {
        addPolygons(scene, "bench leg", dark,
                    boxFaces({x, corner.y, corner.z + 0.06}, {x + kLeg, under, upper.z - 0.06}, kAround));
    }
}

}  // namespace

void addPictures(Scene& scene) {
    const std::uint32_t frame = addMaterial(scene, "picture frame", {0.09f, 0.07f, 0.055f});
    std::array<std::uint32_t, kPaintings> canvases{};
    for (unsigned i = 0; i < kPaintings; ++i) {
        canvases[i] = addMaterial(scene, "canvas " + std::to_string(i + 1), Rgb(0.95f));
        scene.images.push_back(drawPainting(i));
        scene.materials[canvases[i]].reflectanceTexture.image =
            static_cast<std::int32_t>(scene.images.size() - 1);
    }
    constexpr std::array<Hanging, 6> kHangings{{{3.5, 1.6, 1.2, false, 0},
                                                {7.0, 1.2, 1.6, false, 1},
                                                {10.5, 1.6, 1.2, false, 2},
                                                {3.5, 1.2, 1.6, true, 3},
                                                {7.0, 1.6, 1.2, true, 2},
                                                {10.5, 1.2, 1.6, true, 1}}};
    for (const Hanging& hanging : kHangings) {
        addPicture(scene, hanging, frame, canvases[hanging.painting]);
    }
}

void addBenches(Scene& scene) {
    const std::uint32_t wood = addMaterial(scene, "walnut", {0.30f, 0.18f, 0.10f});
    const std::uint32_t dark = addMaterial(scene, "bronze", {0.12f, 0.10f, 0.08f});
    addBench(scene, {8.0, 0.0, 3.0}, {1.6, 0.45, 0.45}, wood, dark);
    addBench(scene, {2.2, 0.0, 2.9}, {1.6, 0.45, 0.45}, wood, dark);
}

}  // namespace fluxwalk::scene::gallery
