#include <algorithm>
#include <cmath>

#include "core/scene/building_furniture.h"

namespace fluxwalk::scene::building {

namespace {

constexpr std::uint64_t kSeed = 0x6275696c64696e67;  // "building"
constexpr double kStairBay = 4.5;
constexpr std::array<double, 4> kBayWidths{4.5, 4.75, 5.25, 5.75};
/// Where the rooms on the near and the far side of the corridor begin, whose floor is between z = 0 and
/// kCorridorWidth.
constexpr double kNearSide = -2.0 * kHalfWall;
constexpr double kFarSide = kCorridorWidth + 2.0 * kHalfWall;
constexpr Opening kDoorOpening{kDoorFrom, kDoorTo, 0.0, kDoorHeight};
/// The well opens to the corridor without a door.
constexpr Opening kHallOpening{0.75, 3.25, 0.0, 2.375};
constexpr double kCellarDepth = 0.5;

/// One storey of a plan: which rooms there are.
struct Storey {
    const Plan& plan;
    unsigned number;

    unsigned bays() const { return static_cast<unsigned>(plan.bays.size()); }
    // Rooms are numbered from the stairs on, near and far side in turn; bay 0 has a far one only.
    bool hasRoom(unsigned bay, bool isFar) const {
        if (bay >= bays() || (bay == 0 && !isFar)) {
            return false;
        }
        return indexOf(bay, isFar) < plan.rooms;
    }
    unsigned indexOf(unsigned bay, bool isFar) const {
        return number * plan.roomsPerStorey() + (bay == 0 ? 0 : 2 * bay - (isFar ? 0 : 1));
    }
    bool hasCell(unsigned bay, bool isFar) const { return hasRoom(bay, isFar) || (bay == 0 && !isFar); }
    bool hasCorridor(unsigned bay) const { return hasCell(bay, false) || hasCell(bay, true); }
    bool isLast() const { return number + 1 == plan.storeys; }
};

struct BayLines {
    double from = 0.0;
    double to = 0.0;
};

BayLines linesOf(const Plan& plan, unsigned bay) {
    BayLines lines;
    for (unsigned i = 0; i < bay; ++i) {
        lines.from += plan.bays[i];
    }
    lines.to = lines.from + plan.bays[bay];
    return lines;
}

// Coordinates of the room of a bay: near rooms are turned half about.
Placement placementOf(const BayLines& lines, bool isFar, double floor) {
    if (isFar) {
        return {{lines.from + kHalfWall, floor, kFarSide}};
    }
    return Placement{{lines.to - kHalfWall, floor, kNearSide}}.moved(Vec3d(0.0), 180.0);
}

// Thickness of the walls in the coordinates of a room: facades where there is no neighbour.
std::array<double, 4> wallsOf(const Storey& storey, unsigned bay, bool isFar) {
    const double left = bay > 0 && storey.hasCell(bay - 1, isFar) ? kHalfWall : kFacade;
    const double right = storey.hasCell(bay + 1, isFar) ? kHalfWall : kFacade;
    return {isFar ? left : right, isFar ? right : left, kHalfWall, kFacade};
}

void addRoom(Workshop& w, const Storey& storey, unsigned bay, bool isFar, double floor) {
    const BayLines lines = linesOf(storey.plan, bay);
    const Placement at = placementOf(lines, isFar, floor);
    base::RandomStream random(base::combine(kSeed, storey.indexOf(bay, isFar)));
    Cell cell;
    cell.width = lines.to - lines.from - 2.0 * kHalfWall;
    cell.depth = kRoomDepth;
    cell.thickness = wallsOf(storey, bay, isFar);
    cell.floor = w.palette.floors[static_cast<std::size_t>(5.0 * random.next())];
    cell.walls = w.palette.walls[static_cast<std::size_t>(6.0 * random.next())];
    const Opening window{0.625, cell.width - 0.625, 0.875, 2.375};
    cell.openings[2].push_back(kDoorOpening);
    cell.openings[3].push_back(window);
    addCell(w, at, cell);
    addWindow(w, at, window);
    const double ajar = random.next();
    const double degrees = ajar < 0.25 ? 0.0 : 15.0 + 90.0 * random.next();
    addDoor(w, at, degrees, w.palette.woods[static_cast<std::size_t>(4.0 * random.next())]);
    const auto kind = static_cast<RoomKind>(static_cast<unsigned>(kRoomKinds * random.next()));
    furnish(w, at, {kind, cell.width, base::combine(kSeed + 1, storey.indexOf(bay, isFar))}, window);
}

void addHall(Workshop& w, const Storey& storey, double floor) {
    const BayLines lines = linesOf(storey.plan, 0);
    StairHall hall;
    hall.width = lines.to - lines.from - 2.0 * kHalfWall;
    hall.thickness = wallsOf(storey, 0, false);
    hall.door = kHallOpening;
    hall.isFirst = storey.number == 0;
    hall.isLast = storey.isLast();
    const Placement at = placementOf(lines, false, floor);
    addStairHall(w, at, hall);
    addPanel(w, at.moved({0.5 * hall.width, kClearHeight, 0.7}));
    if (hall.isLast) {
        addPanel(w, at.moved({0.5 * hall.width, kClearHeight, 3.4}));
    }
}

void addCorridor(Workshop& w, const Storey& storey, unsigned bay, double floor) {
    const BayLines lines = linesOf(storey.plan, bay);
    const bool isFirst = bay == 0;
    const bool isEnd = !storey.hasCorridor(bay + 1);
    const double from = lines.from + (isFirst ? kHalfWall : 0.0);
    const double to = lines.to - (isEnd ? kHalfWall : 0.0);
    Cell cell;
    cell.width = to - from;
    cell.depth = kCorridorWidth;
    cell.thickness = {isFirst ? kFacade : 0.0, isEnd ? kFacade : 0.0, kHalfWall, kHalfWall};
    cell.floor = w.palette.stone;
    cell.walls = w.palette.walls[0];
    const auto addOpening = [&](bool isFar, const Opening& o) {
        const double shift = isFar ? lines.from + kHalfWall - from : lines.to - kHalfWall - from;
        const double a = isFar ? shift + o.from : shift - o.to;
        cell.openings[isFar ? 3 : 2].push_back({a, a + o.to - o.from, o.bottom, o.top});
    };
    for (const bool isFar : {false, true}) {
        if (storey.hasRoom(bay, isFar)) {
            addOpening(isFar, kDoorOpening);
        }
    }
    if (isFirst) {
        addOpening(false, kHallOpening);
    }
    const Placement at{{from, floor, 0.0}};
    constexpr Opening kWindow{0.5, 1.5, 0.875, 2.375};
    // Windows at the ends; a window's own coordinates have its wall at z = kRoomDepth.
    if (isEnd) {
        cell.openings[1].push_back(kWindow);
        addWindow(w, at.moved({cell.width - kRoomDepth, 0.0, kCorridorWidth}, 90.0), kWindow);
    }
    if (isFirst) {
        cell.openings[0].push_back(kWindow);
        addWindow(w, at.moved({kRoomDepth, 0.0, 0.0}, -90.0), kWindow);
    }
    addCell(w, at, cell);
    addPanel(w, at.moved({0.5 * cell.width, kClearHeight, 0.5 * kCorridorWidth}));
    base::RandomStream random(base::combine(base::combine(kSeed + 2, storey.number), bay));
    const auto pick = [&] { return w.palette.colours[static_cast<std::size_t>(8.0 * random.next())]; };
    if (storey.hasRoom(bay, true)) {
        const double x = lines.from + kHalfWall - from + 2.6 + random.next();
        addPicture(w, at.moved({x, 1.6, kCorridorWidth}, 180.0), 0.6 + 0.5 * random.next(), 0.6, pick());
    }
    if (bay > 0 && random.next() < 0.4) {
        addPlant(w, at.moved({1.8, 0.0, 0.4}), 0.8, base::combine(kSeed + 3, storey.indexOf(bay, false)));
    }
}

void addFoundation(Workshop& w, const Plan& plan) {
    const double length = linesOf(plan, static_cast<unsigned>(plan.bays.size() - 1)).to;
    constexpr double kOut = kFacade - kHalfWall;
    w.solids.setPlacement({});
    w.solids.addBox({-kOut, -kCellarDepth, kNearSide - kRoomDepth - kFacade},
                    {length + kOut, -kFloorPlate, kFarSide + kRoomDepth + kFacade});
    w.solids.finish("foundation", w.palette.concrete);
}

}  // namespace

unsigned Detail::grow(unsigned base, double power, unsigned most) const {
    const double grown = std::round(base * std::pow(level, power));
    return grown < most ? static_cast<unsigned>(grown) : most;
}

Plan planStoreys(unsigned rooms) {
    // About as long as high, the last storey as full as possible.
    const double ideal = 1.0 + 0.7 * std::sqrt(static_cast<double>(rooms));
    const auto storeysFor = [rooms](unsigned bays) { return (rooms + 2 * bays - 2) / (2 * bays - 1); };
    const auto least = static_cast<unsigned>(rooms == 1 ? 1.0 : std::round(0.85 * ideal));
    unsigned best = least;
    double bestPart = -1.0;
    for (unsigned bays = least; bays <= std::max(least, static_cast<unsigned>(1.3 * ideal) + 1); ++bays) {
        const double part = rooms / static_cast<double>(storeysFor(bays) * (2 * bays - 1));
        if (part > bestPart) {
            best = bays;
            bestPart = part;
        }
    }
    Plan plan;
    plan.rooms = rooms;
    plan.storeys = storeysFor(best);
    base::RandomStream random(base::combine(kSeed, ~std::uint64_t{0}));
    for (unsigned bay = 0; bay < best; ++bay) {
        plan.bays.push_back(bay == 0 ? kStairBay : kBayWidths[static_cast<std::size_t>(4.0 * random.next())]);
    }
    return plan;
}

std::size_t construct(Scene* scene, const Plan& plan, const Palette& palette, Detail detail) {
    Workshop w{SolidMaker(scene), palette, detail};
    addFoundation(w, plan);
    for (unsigned number = 0; number < plan.storeys; ++number) {
        const Storey storey{plan, number};
        const double floor = number * kStorey;
        addHall(w, storey, floor);
        for (unsigned bay = 0; bay < plan.bays.size(); ++bay) {
            if (storey.hasCorridor(bay)) {
                addCorridor(w, storey, bay, floor);
            }
            for (const bool isFar : {false, true}) {
                if (storey.hasRoom(bay, isFar)) {
                    addRoom(w, storey, bay, isFar, floor);
                }
            }
        }
    }
    return w.solids.patchCount();
}

void addCameras(Scene& scene, const Plan& plan) {
    const double end = linesOf(plan, static_cast<unsigned>(plan.bays.size() - 1)).to;
    addCamera(scene, "corridor", {0.6, 1.6, 1.2}, {std::max(4.0, end), 1.3, 0.95}, 70.0);
    const Placement room = placementOf(linesOf(plan, 0), true, 0.0);
    addCamera(scene, "room", room.at({1.0, 1.7, 0.3}), room.at({2.6, 0.9, 4.2}), 75.0);
    const Placement hall = placementOf(linesOf(plan, 0), false, 0.0);
    addCamera(scene, "stair well", hall.at({2.2, 1.6, 0.35}), hall.at({2.2, 1.5, 4.5}), 85.0);
    if (plan.roomsPerStorey() >= 3 && plan.rooms >= 3) {
        const Placement other = placementOf(linesOf(plan, 1), true, 0.0);
        addCamera(scene, "room by the door", other.at({1.2, 1.7, 0.35}), other.at({2.6, 0.9, 4.2}), 75.0);
    }
}

}  // namespace fluxwalk::scene::building
