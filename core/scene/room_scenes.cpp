#include "core/scene/builders.h"
#include "core/scene/polygons.h"

namespace fluxwalk::scene {

namespace {

// Plan of the two rooms, metres. x runs from the lit room through the door into the dark one.
constexpr double kRoomLength = 4.0;
constexpr double kRoomWidth = 3.6;
constexpr double kRoomHeight = 2.6;
constexpr double kWall = 0.12;
constexpr double kDoorNear = 1.3;
constexpr double kDoorFar = 2.2;
constexpr double kDoorHeight = 2.05;
constexpr double kSecondRoom = kRoomLength + kWall;

// The side of the dividing wall that faces the room at -x, cut so that the door's corners are corners.
Quads wallWithDoor(double x, bool facesMinusX) {
    constexpr std::array<double, 4> kZ{0.0, kDoorNear, kDoorFar, kRoomWidth};
    constexpr std::array<double, 3> kY{0.0, kDoorHeight, kRoomHeight};
    Quads parts;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
            if (i == 1 && j == 0) {
                continue;
            }
            const Vec3d lower(x, kY[j], kZ[i]);
            const Vec3d upper(x, kY[j + 1], kZ[i + 1]);
            parts.push_back(boxFaces(lower, upper, facesMinusX ? kLeft : kRight).front());
        }
    }
    return parts;
}

Quads floorStrips(double x0, double x1) {
    return join({boxFaces({x0, 0, 0}, {x1, 0, kDoorNear}, kTop),
                 boxFaces({x0, 0, kDoorNear}, {x1, 0, kDoorFar}, kTop),
                 boxFaces({x0, 0, kDoorFar}, {x1, 0, kRoomWidth}, kTop)});
}

void addShell(Scene& scene, std::uint32_t walls, std::uint32_t floor, std::uint32_t ceiling) {
    addPolygons(scene, "floor", floor,
                join({floorStrips(0, kRoomLength),
                      boxFaces({kRoomLength, 0, kDoorNear}, {kSecondRoom, 0, kDoorFar}, kTop),
                      floorStrips(kSecondRoom, kSecondRoom + kRoomLength)}));
    const Vec3d size(kRoomLength, kRoomHeight, kRoomWidth);
    const Vec3d second(kSecondRoom, 0, 0);
    addPolygons(scene, "ceiling", ceiling,
                join({boxFaces(Vec3d(0.0), size, kTop, true), boxFaces(second, second + size, kTop, true)}));
    addPolygons(
        scene, "walls of the lit room", walls,
        join({boxFaces(Vec3d(0.0), size, kLeft | kNear | kFar, true), wallWithDoor(kRoomLength, true)}));
    addPolygons(scene, "walls of the dark room", walls,
                join({boxFaces(second, second + size, kRight | kNear | kFar, true),
                      wallWithDoor(kSecondRoom, false)}));
    addPolygons(scene, "door frame", ceiling,
                boxFaces({kRoomLength, 0, kDoorNear}, {kSecondRoom, kDoorHeight, kDoorFar},
                         kNear | kFar | kTop, true));
}

Quads table(const Vec3d& corner, const Vec3d& size, double thickness, double leg) {
    const Vec3d upper = corner + size;
    const double under = upper.y - thickness;
    Quads quads = boxFaces({corner.x, under, corner.z}, upper);
    for (const double x : {corner.x + leg, upper.x - 2 * leg}) {
        for (const double z : {corner.z + leg, upper.z - 2 * leg}) {
            quads = join({quads, boxFaces({x, corner.y, z}, {x + leg, under, z + leg}, kAround)});
        }
    }
    return quads;
}

Quads chair(const Vec3d& corner) {
    return join({table(corner, {0.42, 0.45, 0.42}, 0.04, 0.035),
                 boxFaces(corner + Vec3d(0.0, 0.45, 0.0), corner + Vec3d(0.04, 0.92, 0.42), kStanding)});
}

// Open at +z: back, sides and boards.
Quads bookcase(const Vec3d& corner, const Vec3d& size, unsigned boards) {
    constexpr double kBoard = 0.025;
    const Vec3d upper = corner + size;
    Quads quads = join(
        {boxFaces(corner, {upper.x, upper.y, corner.z + kBoard}, kStanding),
         boxFaces({corner.x, corner.y, corner.z + kBoard}, {corner.x + kBoard, upper.y, upper.z}, kStanding),
         boxFaces({upper.x - kBoard, corner.y, corner.z + kBoard}, upper, kStanding)});
    for (unsigned i = 0; i < boards; ++i) {
        const double y = corner.y + (size.y - kBoard) * (i + 1) / boards;
        quads = join({quads, boxFaces({corner.x + kBoard, y, corner.z + kBoard},
                                      {upper.x - kBoard, y + kBoard, upper.z}, kTop | kBottom | kFar)});
    }
    return quads;
}

// A thin leaf that stands open into the dark room, hinged at the far jamb.
Quads openDoor() {
    constexpr double kThickness = 0.04;
    const Vec3d hinge(kSecondRoom, 0.01, kDoorFar + 0.02);
    const Vec3d along(0.80, 0.0, 0.38);
    const Vec3d across = kThickness * glm::normalize(Vec3d(along.z, 0.0, -along.x));
    const Vec3d up(0.0, kDoorHeight - 0.02, 0.0);
    const Vec3d a = hinge + 0.05 * along;
    const Vec3d b = hinge + along;
    const Vec3d c = b + across;
    const Vec3d d = a + across;
    Quads quads{{a, d, c, b}, {a + up, b + up, c + up, d + up}};
    for (const auto& [from, to] : {std::pair{b, a}, std::pair{c, b}, std::pair{d, c}, std::pair{a, d}}) {
        quads.push_back({to, from, from + up, to + up});
    }
    return quads;
}

}  // namespace

Scene buildTwoRooms() {
    Scene scene;
    scene.name = "two-rooms";
    const std::uint32_t walls = addMaterial(scene, "plaster", {0.78f, 0.75f, 0.68f});
    const std::uint32_t ceiling = addMaterial(scene, "white paint", Rgb(0.85f));
    const std::uint32_t floor = addMaterial(scene, "oak", {0.42f, 0.29f, 0.18f});
    const std::uint32_t wood = addMaterial(scene, "beech", {0.55f, 0.40f, 0.25f});
    const std::uint32_t red = addMaterial(scene, "red cloth", {0.52f, 0.09f, 0.07f});
    const std::uint32_t blue = addMaterial(scene, "blue cloth", {0.10f, 0.18f, 0.42f});
    const std::uint32_t metal = addMaterial(scene, "grey metal", Rgb(0.45f));
    // 3,000 lm from a panel of 1.2 m x 0.3 m.
    const Rgb exitance = Rgb(1.05f, 1.0f, 0.85f) * (3000.0f / 0.36f);
    const std::uint32_t lamp = addMaterial(scene, "lamp", Rgb(0.6f), exitance);
    addShell(scene, walls, floor, ceiling);

    addPolygons(scene, "lamp housing", metal, boxFaces({1.4, 2.25, 1.65}, {2.6, 2.31, 1.95}, kAround | kTop));
    addPolygons(scene, "lamp", lamp, boxFaces({1.4, 2.25, 1.65}, {2.6, 2.31, 1.95}, kBottom));
    addPolygons(scene, "table", wood, table({1.2, 0, 1.35}, {1.6, 0.74, 0.9}, 0.03, 0.06));
    addPolygons(scene, "chair", red, chair({0.75, 0, 1.6}));
    addPolygons(scene, "bookcase", wood, bookcase({2.2, 0, 0.02}, {1.2, 1.9, 0.3}, 5));
    addPolygons(scene, "door", ceiling, openDoor());
    addPolygons(scene, "bed frame", wood, boxFaces({6.1, 0, 0.05}, {8.05, 0.28, 1.05}, kStanding));
    addPolygons(scene, "mattress", blue, boxFaces({6.13, 0.285, 0.08}, {8.02, 0.48, 1.02}));
    addPolygons(scene, "wardrobe", wood, boxFaces({7.5, 0, 2.3}, {8.1, 1.95, 3.58}, kStanding));
    addPolygons(scene, "desk", wood, table({5.4, 0, 2.85}, {1.3, 0.72, 0.65}, 0.03, 0.05));
    addPolygons(scene, "stool", red, table({5.8, 0, 2.3}, {0.4, 0.45, 0.4}, 0.04, 0.035));

    addCamera(scene, "lit room", {0.25, 1.6, 0.35}, {3.4, 1.1, 2.1}, 65.0);
    addCamera(scene, "dark room", {7.8, 1.6, 1.4}, {4.4, 1.0, 1.7}, 65.0);
    addCamera(scene, "through the door", {3.2, 1.6, 1.9}, {6.5, 0.9, 1.7}, 60.0);
    return scene;
}

Scene buildLampBox() {
    Scene scene;
    scene.name = "lamp-box";
    const std::uint32_t walls = addMaterial(scene, "walls", Rgb(0.7f));
    const std::uint32_t shell = addMaterial(scene, "box", Rgb(0.6f));
    const std::uint32_t lamp = addMaterial(scene, "lamp", Rgb(0.5f), Rgb(10000.0f));
    addPolygons(scene, "room", walls, boxFaces(Vec3d(0.0), {4.0, 3.0, 4.0}, kAllFaces, true));
    addPolygons(scene, "box", shell, boxFaces({1.7, 1.2, 1.7}, {2.3, 1.8, 2.3}));
    addPolygons(scene, "lamp", lamp, boxFaces({1.85, 1.7, 1.85}, {2.15, 1.7, 2.15}, kBottom));
    addCamera(scene, "corner", {0.4, 2.0, 0.4}, {2.0, 1.5, 2.0}, 60.0);
    return scene;
}

}  // namespace fluxwalk::scene
