#include <algorithm>

#include "core/scene/building.h"

namespace fluxwalk::scene::building {

namespace {

constexpr unsigned kTreads = 8;
constexpr double kRiser = kStorey / (2 * (kTreads + 1));
constexpr double kTread = 0.28;
constexpr double kFlightWidth = 1.75;
constexpr double kLanding = 1.375;
constexpr double kFlightEnd = kLanding + kTreads * kTread;
/// Thickness under the foot of a riser and of the half landing.
constexpr double kUnder = 0.2;
constexpr double kRailHeight = 0.9;
constexpr double kPost = 0.03;

// One flight that rises along z from the origin, x from 0 to its width; nothing of it is below `floor`.
void addFlight(SolidMaker& solids, double floor) {
    const auto under = [&](unsigned i) { return std::max(floor, i * kRiser - kUnder); };
    const auto top = [](unsigned i) { return (i + 1) * kRiser; };
    constexpr double w = kFlightWidth;
    for (unsigned i = 0; i < kTreads; ++i) {
        const double a = i * kTread;
        const double b = (i + 1) * kTread;
        const double start = i == 0 ? under(0) : top(i - 1);
        solids.addQuad({0, top(i), b}, {w, top(i), b}, {w, top(i), a}, {0, top(i), a});
        solids.addQuad({w, start, a}, {0, start, a}, {0, top(i), a}, {w, top(i), a});
        solids.addQuad({0, under(i), a}, {w, under(i), a}, {w, under(i + 1), b}, {0, under(i + 1), b});
        const double shoulder = i == 0 ? top(0) : top(i - 1);
        solids.addQuad({0, under(i), a}, {0, under(i + 1), b}, {0, top(i), b}, {0, shoulder, a});
        solids.addQuad({w, under(i + 1), b}, {w, under(i), a}, {w, shoulder, a}, {w, top(i), b});
        if (i > 0) {
            solids.addTriangle({0, shoulder, a}, {0, top(i), b}, {0, top(i), a});
            solids.addTriangle({w, top(i), b}, {w, shoulder, a}, {w, top(i), a});
        }
    }
    const double end = kTreads * kTread;
    solids.addQuad({0, under(kTreads), end}, {w, under(kTreads), end}, {w, top(kTreads - 1), end},
                   {0, top(kTreads - 1), end});
}

// Handrail on posts above the treads, its middle at x.
void addFlightRail(SolidMaker& solids, double x, unsigned postsPerTread) {
    const double slope = kRiser / kTread;
    const auto under = [&](double z) { return kRiser + kRailHeight + slope * z; };
    const double x0 = x - 0.5 * kPost;
    const double x1 = x + 0.5 * kPost;
    for (unsigned i = 0; i < kTreads; ++i) {
        for (unsigned k = 0; k < postsPerTread; ++k) {
            const double z0 = (i + (k + 0.5) / postsPerTread) * kTread - 0.5 * kPost;
            const double z1 = z0 + kPost;
            const double foot = (i + 1) * kRiser;
            solids.addHexahedron({Vec3d{x0, foot, z1},
                                  {x1, foot, z1},
                                  {x1, foot, z0},
                                  {x0, foot, z0},
                                  {x0, under(z1), z1},
                                  {x1, under(z1), z1},
                                  {x1, under(z0), z0},
                                  {x0, under(z0), z0}});
        }
    }
    const double end = kTreads * kTread;
    const double a = x - 0.035;
    const double b = x + 0.035;
    constexpr double kThick = 0.05;
    solids.addHexahedron({Vec3d{a, under(end), end},
                          {b, under(end), end},
                          {b, under(0.0), 0.0},
                          {a, under(0.0), 0.0},
                          {a, under(end) + kThick, end},
                          {b, under(end) + kThick, end},
                          {b, under(0.0) + kThick, 0.0},
                          {a, under(0.0) + kThick, 0.0}});
}

// Level rail along x at z, on a floor at y = 0.
void addLevelRail(SolidMaker& solids, double from, double to, double z, unsigned posts) {
    for (unsigned i = 0; i < posts; ++i) {
        const double x = from + (to - from) * (i + 0.5) / posts;
        solids.addBox({x - 0.5 * kPost, 0.0, z - 0.5 * kPost}, {x + 0.5 * kPost, 1.0, z + 0.5 * kPost});
    }
    solids.addBox({from, 1.0, z - 0.035}, {to, 1.05, z + 0.035});
}

// The well's floor plate and ceiling: whole in the first and the last storey, elsewhere a landing.
void addLanding(Workshop& w, const StairHall& hall, bool isWhole, bool isCeiling) {
    const auto& t = hall.thickness;
    const double bottom = isCeiling ? kClearHeight : -kFloorPlate;
    const double top = isCeiling ? kClearHeight + kSlab : 0.0;
    if (isWhole) {
        w.solids.addFramedSlab({-t[0], -t[2], hall.width + t[1], kRoomDepth + t[3]},
                               {0.0, 0.0, hall.width, kRoomDepth}, bottom, top, isCeiling);
    } else {
        w.solids.addGridSlab(std::array{0.0, hall.width}, std::array{-t[2], 0.0, kLanding}, bottom, top);
    }
    w.solids.finish(isCeiling ? "ceiling" : "landing", isCeiling ? w.palette.white : w.palette.stone);
}

// Three walls pass the slabs; the one to the corridor stands between them.
void addHallWalls(Workshop& w, const Placement& at, const StairHall& hall, const Opening& window) {
    const auto& t = hall.thickness;
    const double low = hall.isFirst ? 0.0 : -kFloorPlate;
    const double high = hall.isLast ? kClearHeight : kClearHeight + kSlab;
    Cell around;
    around.width = hall.width;
    around.depth = kRoomDepth;
    around.thickness = {t[0], t[1], 0.0, t[3]};
    around.openings[3].push_back(window);
    around.walls = w.palette.walls[0];
    addWalls(w, at, around, low, high);
    Cell front = around;
    front.thickness = {0.0, 0.0, t[2], 0.0};
    front.openings[2].push_back(hall.door);
    addWalls(w, at, front, 0.0, kClearHeight);
    w.solids.addBox({-t[0], low, -t[2]}, {0.0, high, 0.0});
    w.solids.addBox({hall.width, low, -t[2]}, {hall.width + t[1], high, 0.0});
    w.solids.finish("pier", front.walls);
}

}  // namespace

void addStairHall(Workshop& w, const Placement& at, const StairHall& hall) {
    w.solids.setPlacement(at);
    addLanding(w, hall, hall.isFirst, false);
    addLanding(w, hall, hall.isLast, true);
    const Opening window{0.5 * hall.width - 0.625, 0.5 * hall.width + 0.625, 1.75, 2.625};
    addHallWalls(w, at, hall, window);
    addWindow(w, at, window);

    const unsigned postsPerTread = w.detail.grow(1, 0.35, 2);
    const double gapFrom = kFlightWidth;
    const double gapTo = hall.width - kFlightWidth;
    const double half = 0.5 * kStorey;
    w.solids.setPlacement(at);
    if (!hall.isFirst) {
        addLevelRail(w.solids, hall.isLast ? 0.0 : gapFrom, gapTo, kLanding - 0.06,
                     (hall.isLast ? 8u : 2u) * postsPerTread);
        w.solids.finish("railing", w.palette.steel);
    }
    if (hall.isLast) {
        return;
    }
    w.solids.addBox({0.0, half - kUnder, kFlightEnd}, {hall.width, half, kRoomDepth});
    w.solids.finish("half landing", w.palette.stone);
    w.solids.setPlacement(at.moved({0.0, half, 0.0}));
    addLevelRail(w.solids, gapFrom, gapTo, kFlightEnd + 0.06, 2 * postsPerTread);
    w.solids.finish("railing", w.palette.steel);
    const std::array flights{at.moved({0.0, 0.0, kLanding}), at.moved({hall.width, half, kFlightEnd}, 180.0)};
    for (std::size_t i = 0; i < flights.size(); ++i) {
        w.solids.setPlacement(flights[i]);
        addFlight(w.solids, i == 0 && hall.isFirst ? 0.0 : -kUnder);
        w.solids.finish("stairs", w.palette.stone);
        addFlightRail(w.solids, kFlightWidth - 0.06, postsPerTread);
        w.solids.finish("railing", w.palette.steel);
    }
}

}  // namespace fluxwalk::scene::building
