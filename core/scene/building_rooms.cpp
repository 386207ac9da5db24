#include <algorithm>

#include "core/scene/building_furniture.h"

namespace fluxwalk::scene::building {

namespace {

/// A room while it is furnished. Wood, cloth and colours are the room's own choice.
struct Furnishing {
    Workshop& w;
    Placement at;
    double width;
    std::uint64_t key;
    base::RandomStream random;
    std::uint32_t wood = 0;
    std::uint32_t cloth = 0;
    std::uint32_t rug = 0;

    Furnishing(Workshop& workshop, const Placement& placement, const Room& room)
        : w(workshop), at(placement), width(room.width), key(room.key), random(room.key) {
        const Palette& p = w.palette;
        wood = p.woods[pick(p.woods.size())];
        cloth = p.cloths[pick(p.cloths.size())];
        rug = p.cloths[pick(p.cloths.size())];
    }

    std::size_t pick(std::size_t count) {
        return static_cast<std::size_t>(random.next() * static_cast<double>(count));
    }
    std::uint32_t pickColour() { return w.palette.colours[pick(w.palette.colours.size())]; }
    double jitter(double size) { return size * (2.0 * random.next() - 1.0); }
    std::uint64_t keyOf(unsigned part) const { return base::combine(key, part); }

    Placement on(double x, double y, double z, double degrees = 0.0) const {
        return at.moved({x, y, z}, degrees);
    }
    Placement onFloor(double x, double z, double degrees = 0.0) const { return on(x, 0.0, z, degrees); }
    Placement underCeiling(double x, double z, double degrees = 0.0) const {
        return on(x, kClearHeight, z, degrees);
    }
};

void addPictures(Furnishing& f, double from, double to, unsigned count, bool isLeft) {
    for (unsigned i = 0; i < count; ++i) {
        const double z = from + (to - from) * (i + 0.5) / count;
        const double width = 0.45 + 0.4 * f.random.next();
        const double height = 0.4 + 0.3 * f.random.next();
        addPicture(f.w, f.on(isLeft ? 0.0 : f.width, 1.65, z, isLeft ? 90.0 : -90.0), width, height,
                   f.pickColour());
    }
}

// A desk along a wall with what lies on it, the sitter's back to the room; the desk's front is its +z.
void addWorkplace(Furnishing& f, double x, double z, double degrees, unsigned part) {
    constexpr double kHeight = 0.73;
    const Placement desk = f.onFloor(x, z, degrees);
    addTable(f.w, desk, {1.6, kHeight, 0.75}, f.wood);
    const Placement top = desk.moved({0.0, kHeight, 0.0});
    addScreen(f.w, top.moved({f.jitter(0.2), 0.0, -0.2}), 0.52);
    addKeyboard(f.w, top.moved({f.jitter(0.05), 0.0, 0.13}));
    addMug(f.w, top.moved({0.42 + f.jitter(0.06), 0.0, 0.08}, 360.0 * f.random.next()), f.pickColour());
    addPaper(f.w, top.moved({-0.5, 0.0, 0.05}, f.jitter(25.0)));
    if (part % 2 == 0) {
        addStandLamp(f.w, top.moved({-0.62, 0.0, -0.22}), 0.45);
    }
    addOfficeChair(f.w, desk.moved({f.jitter(0.15), 0.0, 0.72}, 180.0 + f.jitter(35.0)), f.cloth);
}

void furnishOffice(Furnishing& f) {
    const double far = kRoomDepth - 1.5;
    addWorkplace(f, 0.395, far, 90.0, 0);
    addWorkplace(f, f.width - 0.395, far, -90.0, 1);
    const double room = f.width - 1.9;
    const unsigned cases = room > 2.2 ? 2 : 1;
    const double wide = std::min(1.0, (room - 0.2) / cases);
    for (unsigned i = 0; i < cases; ++i) {
        addBookcase(f.w, f.onFloor(f.width - 0.05 - (i + 0.5) * (wide + 0.02), 0.01), wide, 5, f.wood,
                    f.keyOf(10 + i));
    }
    addPlant(f.w, f.onFloor(f.width - 0.45, kRoomDepth - 0.45), 0.9, f.keyOf(20));
    addBin(f.w, f.onFloor(0.3, far - 1.05));
    addPictures(f, far - 0.8, far + 0.4, 1, true);
    addPictures(f, 0.9, 2.6, 1, false);
    for (const double z : {1.7, 3.7}) {
        addPanel(f.w, f.underCeiling(0.5 * f.width, z, 90.0));
    }
}

void furnishMeeting(Furnishing& f) {
    const double z = 3.0;
    const double x = 0.5 * f.width;
    addTable(f.w, f.onFloor(x, z, 90.0), {2.2, 0.74, 1.0}, f.wood);
    for (unsigned i = 0; i < 3; ++i) {
        const double along = z + (i - 1.0) * 0.72 + f.jitter(0.04);
        addChair(f.w, f.onFloor(x - 0.72 - 0.12 * f.random.next(), along, 90.0 + f.jitter(12.0)), f.wood,
                 f.cloth);
        addChair(f.w, f.onFloor(x + 0.72 + 0.12 * f.random.next(), along, -90.0 + f.jitter(12.0)), f.wood,
                 f.cloth);
    }
    addBowl(f.w, f.on(x, 0.74, z), 0.17, f.pickColour());
    for (const double side : {-0.28, 0.28}) {
        addPaper(f.w, f.on(x + side, 0.74, z + side * 2.2, 90.0 + f.jitter(15.0)));
        addMug(f.w, f.on(x + side, 0.74, z - side * 1.2 + 0.2), f.w.palette.white);
    }
    // Whiteboard, and a low case below the pictures opposite.
    addPicture(f.w, f.on(f.width, 1.5, z, -90.0), 1.8, 1.0, f.w.palette.white);
    addPictures(f, 2.0, 4.4, 2, true);
    addBookcase(f.w, f.onFloor(f.width - 0.75, 0.01), 1.2, 2, f.wood, f.keyOf(10));
    addPlant(f.w, f.onFloor(0.42, kRoomDepth - 0.45), 1.0, f.keyOf(20));
    for (const double along : {-0.7, 0.0, 0.7}) {
        addPendant(f.w, f.underCeiling(x, z + along), 0.75);
    }
    addPanel(f.w, f.underCeiling(x, 1.0));
}

void furnishLiving(Furnishing& f) {
    const double z = 3.2;
    addRug(f.w, f.onFloor(f.width - 1.75, z, 90.0), 2.2, 1.6, f.rug);
    addSofa(f.w, f.onFloor(f.width - 0.02, z, -90.0), 2.0, f.cloth, f.keyOf(1));
    addSofa(f.w, f.onFloor(0.95, kRoomDepth - 0.75, 145.0 + f.jitter(10.0)), 0.95, f.rug, f.keyOf(2));
    const Placement table = f.on(f.width - 1.7, 0.012, z, 90.0 + f.jitter(3.0));
    addTable(f.w, table, {0.95, 0.38, 0.5}, f.wood);
    addBowl(f.w, table.moved({0.2, 0.38, 0.05}), 0.13, f.pickColour());
    addPaper(f.w, table.moved({-0.2, 0.38, 0.0}, f.jitter(40.0)));
    const double room = f.width - 1.9;
    addBookcase(f.w, f.onFloor(f.width - 0.05 - 0.5 * std::min(1.3, room), 0.01), std::min(1.3, room), 5,
                f.wood, f.keyOf(10));
    addTable(f.w, f.onFloor(0.24, 2.5, 90.0), {1.3, 0.42, 0.42}, f.wood);
    addScreen(f.w, f.on(0.2, 0.42, 2.5, 90.0), 1.0);
    addPlant(f.w, f.onFloor(f.width - 0.45, kRoomDepth - 0.63), 0.85, f.keyOf(20));
    addStandLamp(f.w, f.onFloor(f.width - 0.35, 1.85), 1.5);
    addPictures(f, 2.5, 4.1, 2, false);
    addGlobe(f.w, f.underCeiling(0.5 * f.width, 2.5), 0.4);
}

void furnishBedroom(Furnishing& f) {
    const double z = 3.45;
    addRug(f.w, f.onFloor(f.width - 2.55, z, 90.0), 1.5, 0.8, f.rug);
    addBed(f.w, f.onFloor(f.width - 0.02, z, -90.0), f.wood, f.cloth);
    for (const double side : {-1.1, 1.1}) {
        const Placement at = f.onFloor(f.width - 0.24, z + side, -90.0);
        addTable(f.w, at, {0.42, 0.45, 0.4}, f.wood);
        addStandLamp(f.w, at.moved({0.05, 0.45, -0.05}), 0.42);
        addPaper(f.w, at.moved({-0.08, 0.45, 0.03}, f.jitter(20.0)));
    }
    addWardrobe(f.w, f.onFloor(f.width - 0.05 - 0.5 * std::min(1.6, f.width - 2.0), 0.01),
                std::min(1.6, f.width - 2.0), f.wood);
    addTable(f.w, f.onFloor(0.36, 3.6, 90.0), {1.1, 0.73, 0.6}, f.wood);
    addChair(f.w, f.onFloor(0.75, 3.6 + f.jitter(0.1), -90.0 + f.jitter(20.0)), f.wood, f.cloth);
    addBooks(f.w, f.on(0.08, 0.73, 3.9, 90.0), 0.0, 0.3, 0.3, f.keyOf(30));
    addPictures(f, 3.1, 4.1, 1, true);
    addPictures(f, 2.7, 4.2, 2, false);
    addPendant(f.w, f.underCeiling(0.5 * f.width, 2.3), 0.45);
}

void furnishKitchen(Furnishing& f) {
    const double counter = 2.6;
    addKitchenCounter(f.w, f.onFloor(f.width - 0.01, kRoomDepth - 0.35 - 0.5 * counter, -90.0), counter,
                      f.wood, f.keyOf(1));
    const double x = 1.4;
    const double z = 3.2;
    addRoundTable(f.w, f.onFloor(x, z), 0.55, 0.74, f.wood);
    for (unsigned i = 0; i < 4; ++i) {
        const Placement place = f.onFloor(x, z, 45.0 + 90.0 * i + f.jitter(10.0));
        addChair(f.w, place.moved({0.0, 0.0, -0.66 - 0.1 * f.random.next()}), f.wood, f.cloth);
        addMug(f.w, place.moved({0.1, 0.74, -0.28}), f.pickColour());
        addBowl(f.w, place.moved({-0.08, 0.74, -0.38}), 0.1, f.w.palette.white);
    }
    addBowl(f.w, f.on(x, 0.74, z), 0.15, f.pickColour());
    addBottle(f.w, f.on(x + 0.18, 0.74, z + 0.05), 0.3, f.w.palette.leaf);
    addBookcase(f.w, f.onFloor(f.width - 0.7, 0.01), 1.1, 5, f.wood, f.keyOf(10));
    addBin(f.w, f.onFloor(f.width - 0.3, 1.75));
    addPictures(f, 2.3, 4.2, 2, true);
    addPendant(f.w, f.underCeiling(x, z), 0.8);
    addPanel(f.w, f.underCeiling(f.width - 1.2, 2.6, 90.0));
}

}  // namespace

void furnish(Workshop& w, const Placement& at, const Room& room, const Opening& window) {
    Furnishing f(w, at, room);
    switch (room.kind) {
        case RoomKind::office:
            furnishOffice(f);
            break;
        case RoomKind::meeting:
            furnishMeeting(f);
            break;
        case RoomKind::living:
            furnishLiving(f);
            break;
        case RoomKind::bedroom:
            furnishBedroom(f);
            break;
        case RoomKind::kitchen:
            furnishKitchen(f);
            break;
    }
    const double middle = 0.5 * (window.from + window.to);
    addRadiator(w, at.moved({middle, 0.0, kRoomDepth}, 180.0), window.to - window.from - 0.9);
    const bool isHome = room.kind == RoomKind::living || room.kind == RoomKind::bedroom;
    if (isHome) {
        addCurtains(w, at, window, f.cloth);
    } else {
        addBlinds(w, at, window, 0.25 + 0.6 * f.random.next());
    }
}

}  // namespace fluxwalk::scene::building
