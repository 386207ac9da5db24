#include "core/scene/building_furniture.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"

namespace fluxwalk::scene::building {

namespace {

/// Level from which legs and posts are turned instead of square.
constexpr double kTurnedFrom = 1.5;

// A turned leg or post: it swells and narrows along its height, with as many rings as the level gives.
void addTurnedPost(Workshop& w, const Vec3d& foot, double radius, double height) {
    const unsigned segments = std::max(5u, w.detail.grow(4, 0.5));
    const unsigned rings = std::max(3u, w.detail.grow(3, 0.5));
    std::vector<LatheRing> profile;
    for (unsigned i = 0; i <= rings; ++i) {
        const double t = static_cast<double>(i) / rings;
        const double swell = 0.72 + 0.2 * t + 0.08 * std::cos(6.0 * base::kPi * t * (1.0 + t));
        profile.push_back({radius * swell, height * t});
    }
    w.solids.addTurned(foot, profile, segments);
}

void addPost(Workshop& w, const Vec3d& foot, double thickness, double height) {
    if (w.detail.level >= kTurnedFrom) {
        addTurnedPost(w, foot, 0.6 * thickness, height);
    } else {
        const Vec3d half(0.5 * thickness, 0.0, 0.5 * thickness);
        w.solids.addBox(foot - half, foot + half + Vec3d(0.0, height, 0.0));
    }
}

// A seat, back or mattress: a box, rounded where the level allows.
void addUpholstery(Workshop& w, const Vec3d& lower, const Vec3d& upper) {
    if (w.detail.level >= 2.0) {
        w.solids.addCushion(lower, upper, w.detail.grow(2, 0.5));
    } else {
        w.solids.addBox(lower, upper);
    }
}

}  // namespace

void addLegs(Workshop& w, double halfX, double halfZ, double height, double thickness) {
    for (const double x : {-halfX, halfX}) {
        for (const double z : {-halfZ, halfZ}) {
            addPost(w, {x, 0.0, z}, thickness, height);
        }
    }
}

void addTable(Workshop& w, const Placement& at, const Vec3d& size, std::uint32_t wood) {
    constexpr double kTop = 0.03;
    const Vec3d half = 0.5 * size;
    const double under = size.y - kTop;
    w.solids.setPlacement(at);
    w.solids.addBox({-half.x, under, -half.z}, {half.x, size.y, half.z});
    w.solids.finish("table top", wood);
    addLegs(w, half.x - 0.06, half.z - 0.06, under, 0.055);
    const double apron = under - 0.07;
    if (w.detail.level >= 1.3) {
        for (const double z : {-half.z + 0.06, half.z - 0.06}) {
            w.solids.addBox({-half.x + 0.1, apron, z - 0.01}, {half.x - 0.1, under, z + 0.01});
        }
    }
    w.solids.finish("table legs", wood);
}

void addRoundTable(Workshop& w, const Placement& at, double radius, double height, std::uint32_t wood) {
    const unsigned segments = 4 * w.detail.grow(4, 0.5);
    w.solids.setPlacement(at);
    const std::array<LatheRing, 2> top{LatheRing{radius, height - 0.03}, {radius, height}};
    w.solids.addTurned(Vec3d(0.0), top, segments);
    w.solids.finish("table top", wood);
    const std::array<LatheRing, 3> foot{LatheRing{0.32, 0.0}, {0.32, 0.025}, {0.09, 0.06}};
    w.solids.addTurned(Vec3d(0.0), foot, segments);
    w.solids.finish("table foot", w.palette.steel);
    w.solids.placeCylinder("table column", w.palette.steel, {0.0, 0.06, 0.0}, 0.045, height - 0.03 - 0.06);
}

void addChair(Workshop& w, const Placement& at, std::uint32_t wood, std::uint32_t cloth) {
    constexpr double kSeat = 0.44;
    constexpr double kHalf = 0.21;
    constexpr double kTop = 0.88;
    w.solids.setPlacement(at);
    addLegs(w, kHalf - 0.03, kHalf - 0.03, kSeat - 0.03, 0.036);
    w.solids.addBox({-kHalf, kSeat - 0.03, -kHalf}, {kHalf, kSeat, kHalf});
    // Back: two posts, spindles between seat and rail.
    const double z = -kHalf + 0.025;
    for (const double x : {-kHalf + 0.025, kHalf - 0.025}) {
        addPost(w, {x, kSeat, z}, 0.034, kTop - kSeat - 0.09);
    }
    const unsigned spindles = w.detail.level >= 1.3 ? w.detail.grow(2, 0.6, 9) : 0;
    for (unsigned i = 0; i < spindles; ++i) {
        const double x = (kHalf - 0.05) * (2.0 * (i + 1.0) / (spindles + 1.0) - 1.0);
        addPost(w, {x, kSeat, z}, 0.016, kTop - kSeat - 0.09);
    }
    w.solids.addBox({-kHalf, kTop - 0.09, z - 0.012}, {kHalf, kTop, z + 0.012});
    w.solids.finish("chair", wood);
    addUpholstery(w, {-kHalf + 0.02, kSeat, -kHalf + 0.06}, {kHalf - 0.02, kSeat + 0.035, kHalf - 0.01});
    w.solids.finish("chair cushion", cloth);
}

void addOfficeChair(Workshop& w, const Placement& at, std::uint32_t cloth) {
    constexpr double kSeat = 0.42;
    constexpr double kHub = 0.09;
    w.solids.setPlacement(at);
    addUpholstery(w, {-0.24, kSeat, -0.23}, {0.24, kSeat + 0.08, 0.25});
    w.solids.finish("chair seat", cloth);
    addUpholstery(w, {-0.22, 0.58, -0.29}, {0.22, 1.08, -0.22});
    w.solids.finish("chair back", cloth);
    w.solids.addBox({-0.035, kSeat - 0.03, -0.3}, {0.035, kSeat, 0.1});
    w.solids.addBox({-0.035, kSeat, -0.315}, {0.035, 0.75, -0.29});
    for (const double x : {-0.27, 0.23}) {
        w.solids.addBox({x, 0.64, -0.15}, {x + 0.04, 0.67, 0.13});
        const double post = x < 0.0 ? x + 0.001 : x + 0.019;
        w.solids.addBox({post, kSeat, -0.03}, {post + 0.02, 0.64, 0.01});
    }
    w.solids.addBox({-0.27, kSeat - 0.03, -0.02}, {-0.035, kSeat, 0.0});
    w.solids.addBox({0.035, kSeat - 0.03, -0.02}, {0.27, kSeat, 0.0});
    w.solids.finish("chair frame", w.palette.black);
    w.solids.placeCylinder("chair column", w.palette.steel, {0.0, kHub, 0.0}, 0.028, kSeat - 0.03 - kHub);
    const std::array<LatheRing, 2> hub{LatheRing{0.045, 0.055}, {0.045, kHub}};
    w.solids.addTurned(Vec3d(0.0), hub, 5 * w.detail.grow(1, 0.3));
    constexpr unsigned kArms = 5;
    for (unsigned i = 0; i < kArms; ++i) {
        const double turn = 360.0 / kArms * (i + 0.5);
        w.solids.setPlacement(at.moved(Vec3d(0.0), turn));
        w.solids.addBox({0.047, 0.055, -0.018}, {0.3, 0.08, 0.018});
        w.solids.addBox({0.265, 0.0, -0.02}, {0.3, 0.055, 0.02});
    }
    w.solids.finish("chair star", w.palette.steel);
}

void addSofa(Workshop& w, const Placement& at, double width, std::uint32_t cloth, std::uint64_t key) {
    constexpr double kDepth = 0.85;
    constexpr double kArm = 0.16;
    const double half = 0.5 * width;
    const unsigned seats = width > 1.3 ? 2 : 1;
    const double seat = (width - 2.0 * kArm) / seats;
    w.solids.setPlacement(at);
    w.solids.addBox({-half + kArm, 0.09, 0.2}, {half - kArm, 0.28, kDepth});
    w.solids.addBox({-half + kArm, 0.08, 0.0}, {half - kArm, 0.78, 0.2});
    w.solids.addBox({-half, 0.08, 0.0}, {-half + kArm, 0.6, kDepth});
    w.solids.addBox({half - kArm, 0.08, 0.0}, {half, 0.6, kDepth});
    w.solids.finish("sofa", cloth);
    for (unsigned i = 0; i < seats; ++i) {
        const double x = -half + kArm + i * seat;
        addUpholstery(w, {x + 0.005, 0.28, 0.22}, {x + seat - 0.005, 0.44, kDepth + 0.01});
        addUpholstery(w, {x + 0.01, 0.45, 0.205}, {x + seat - 0.01, 0.82, 0.36});
    }
    w.solids.finish("sofa cushions", cloth);
    for (const double x : {-half + 0.07, half - 0.07}) {
        for (const double z : {0.07, kDepth - 0.07}) {
            addPost(w, {x, 0.0, z}, 0.05, 0.08);
        }
    }
    w.solids.finish("sofa feet", w.palette.black);
    base::RandomStream random(key);
    const unsigned loose = 1 + static_cast<unsigned>(2.0 * random.next());
    for (unsigned i = 0; i < loose && i < seats; ++i) {
        const double x = (i == 0 ? -1.0 : 1.0) * (half - kArm - 0.26);
        w.solids.addCushion({x - 0.2, 0.46, 0.4}, {x + 0.2, 0.6, 0.8}, w.detail.grow(2, 0.5));
        w.solids.finish("cushion", w.palette.colours[static_cast<std::size_t>(8.0 * random.next())]);
    }
}

void addBed(Workshop& w, const Placement& at, std::uint32_t wood, std::uint32_t cloth) {
    constexpr double kHalf = 0.8;
    constexpr double kLength = 2.05;
    w.solids.setPlacement(at);
    w.solids.addBox({-kHalf, 0.0, 0.0}, {kHalf, 0.95, 0.05});
    w.solids.addBox({-kHalf + 0.03, 0.12, 0.05}, {kHalf - 0.03, 0.3, kLength});
    for (const double x : {-kHalf + 0.08, kHalf - 0.08}) {
        for (const double z : {0.2, kLength - 0.08}) {
            addPost(w, {x, 0.0, z}, 0.06, 0.12);
        }
    }
    w.solids.finish("bed", wood);
    w.solids.addBox({-kHalf + 0.04, 0.3, 0.055}, {kHalf - 0.04, 0.46, kLength - 0.02});
    w.solids.finish("mattress", w.palette.paper);
    addUpholstery(w, {-kHalf + 0.01, 0.46, 0.62}, {kHalf - 0.01, 0.54, kLength - 0.01});
    w.solids.finish("blanket", cloth);
    for (const double x : {-0.4, 0.4}) {
        w.solids.addCushion({x - 0.34, 0.46, 0.1}, {x + 0.34, 0.6, 0.58}, w.detail.grow(2, 0.5));
    }
    w.solids.finish("pillows", w.palette.white);
}

void addWardrobe(Workshop& w, const Placement& at, double width, std::uint32_t wood) {
    constexpr double kHeight = 2.1;
    constexpr double kDepth = 0.58;
    const double half = 0.5 * width;
    const auto doors = static_cast<unsigned>(std::max(2.0, std::round(width / 0.5)));
    const double pitch = width / doors;
    w.solids.setPlacement(at);
    w.solids.addBox({-half, 0.06, 0.0}, {half, kHeight, kDepth});
    w.solids.addBox({-half + 0.03, 0.0, 0.0}, {half - 0.03, 0.06, kDepth - 0.04});
    w.solids.finish("wardrobe", wood);
    const unsigned slats = w.detail.level >= 2.0 ? w.detail.grow(3, 0.7, 40) : 0;
    for (unsigned i = 0; i < doors; ++i) {
        const double from = -half + i * pitch + 0.006;
        const double to = from + pitch - 0.012;
        w.solids.addBox({from, 0.075, kDepth}, {to, kHeight - 0.015, kDepth + 0.02});
        for (unsigned s = 0; s < slats; ++s) {
            const double y = 0.16 + s * (kHeight - 0.3) / slats;
            w.solids.addBox({from + 0.06, y, kDepth + 0.02},
                            {to - 0.06, y + 0.6 * (kHeight - 0.3) / slats, kDepth + 0.032});
        }
    }
    w.solids.finish("wardrobe doors", wood);
    for (unsigned i = 0; i < doors; ++i) {
        const double edge = -half + (i % 2 == 0 ? i + 1.0 : static_cast<double>(i)) * pitch;
        const double x = edge + (i % 2 == 0 ? -0.045 : 0.025);
        w.solids.addBox({x, 0.95, kDepth + 0.035}, {x + 0.02, 1.15, kDepth + 0.05});
    }
    w.solids.finish("wardrobe handles", w.palette.steel);
}

void addBookcase(Workshop& w, const Placement& at, double width, unsigned boards, std::uint32_t wood,
                 std::uint64_t key) {
    constexpr double kBoard = 0.025;
    constexpr double kDepth = 0.3;
    constexpr double kPitch = 0.36;
    const double half = 0.5 * width;
    const double height = boards * kPitch + kBoard;
    w.solids.setPlacement(at);
    // A mesh's solids never share a whole edge, so that each edge has two faces: hence small insets.
    w.solids.addBox({-half + 0.004, 0.004, 0.0}, {half - 0.004, height - 0.004, 0.015});
    for (const double x : {-half, half - kBoard}) {
        w.solids.addBox({x, 0.0, 0.015}, {x + kBoard, height, kDepth});
    }
    for (unsigned i = 0; i <= boards; ++i) {
        const double y = i * kPitch;
        w.solids.addBox({-half + kBoard, y, 0.015}, {half - kBoard, y + kBoard, kDepth - 0.005});
    }
    w.solids.finish("bookcase", wood);
    const double from = -half + kBoard;
    const double to = half - kBoard;
    for (unsigned i = 0; i <= boards; ++i) {
        base::RandomStream random(base::combine(key, i));
        const double y = i * kPitch + kBoard;
        const Placement board = at.moved({0.0, y, 0.02});
        const double split = from + (to - from) * (0.35 + 0.5 * random.next());
        const auto colour = w.palette.colours[static_cast<std::size_t>(8.0 * random.next())];
        const std::uint64_t books = base::combine(key, 100 + i);
        const double place = 0.5 * (split + to);
        if (i == boards || random.next() < 0.25) {
            addBowl(w, board.moved({place, 0.0, 0.14}), std::min(0.1, 0.45 * (to - split)), colour);
            if (i < boards) {
                addBooks(w, board, from, split - 0.05, kPitch - kBoard, books);
            }
        } else if (random.next() < 0.3) {
            w.solids.setPlacement(board);
            const double r = std::min(0.09, 0.45 * (to - split));
            w.solids.placeSphere("ball", colour, {place, r, 0.14}, r);
            addBooks(w, board, from, split - 0.05, kPitch - kBoard, books);
        } else if (random.next() < 0.3) {
            w.solids.setPlacement(board);
            w.solids.addBox({split, 0.0, 0.01}, {to - 0.01, 0.2, 0.25});
            w.solids.finish("storage box", colour);
            addBooks(w, board, from, split - 0.05, kPitch - kBoard, books);
        } else {
            addBooks(w, board, from, split + 0.5 * (to - split), kPitch - kBoard, books);
        }
    }
}

void addKitchenCounter(Workshop& w, const Placement& at, double width, std::uint32_t wood,
                       std::uint64_t key) {
    constexpr double kDepth = 0.58;
    constexpr double kTop = 0.88;
    const double half = 0.5 * width;
    const auto units = static_cast<unsigned>(std::max(2.0, std::round(width / 0.6)));
    const double pitch = width / units;
    w.solids.setPlacement(at);
    w.solids.addBox({-half, 0.1, 0.0}, {half, kTop, kDepth - 0.02});
    w.solids.addBox({-half + 0.01, 0.0, 0.0}, {half - 0.01, 0.1, kDepth - 0.08});
    w.solids.addBox({-half, 1.45, 0.0}, {half, 2.1, 0.33});
    w.solids.finish("kitchen units", w.palette.white);
    for (unsigned i = 0; i < units; ++i) {
        const double from = -half + i * pitch + 0.004;
        const double to = from + pitch - 0.008;
        const unsigned drawers = i % 2 == 0 ? w.detail.grow(1, 0.6, 5) : 1;
        for (unsigned d = 0; d < drawers; ++d) {
            const double y = 0.11 + d * (kTop - 0.12) / drawers;
            w.solids.addBox({from, y, kDepth - 0.02},
                            {to, y + (kTop - 0.12) / drawers - 0.006, kDepth - 0.002});
        }
        w.solids.addBox({from, 1.455, 0.33}, {to, 2.095, 0.348});
    }
    w.solids.finish("kitchen fronts", wood);
    w.solids.addBox({-half, kTop, 0.0}, {half, kTop + 0.035, kDepth + 0.02});
    w.solids.finish("worktop", w.palette.stone);
    base::RandomStream random(key);
    const Placement top = at.moved({0.0, kTop + 0.035, 0.0});
    const unsigned things = 3 + w.detail.grow(1, 0.5, 12);
    for (unsigned i = 0; i < things; ++i) {
        const double x = -half + width * (i + 0.3 + 0.4 * random.next()) / things;
        const Placement place = top.moved({x, 0.0, 0.2 + 0.12 * random.next()});
        const auto colour = w.palette.colours[static_cast<std::size_t>(8.0 * random.next())];
        switch (i % 3) {
            case 0:
                addBottle(w, place, 0.24 + 0.08 * random.next(), colour);
                break;
            case 1:
                addBowl(w, place, 0.11, colour);
                break;
            default:
                addMug(w, place, colour);
        }
    }
}

void addRug(Workshop& w, const Placement& at, double width, double depth, std::uint32_t cloth) {
    constexpr double kThick = 0.012;
    w.solids.setPlacement(at);
    w.solids.addBox({-0.5 * width, 0.0, -0.5 * depth}, {0.5 * width, kThick, 0.5 * depth});
    if (w.detail.level >= 2.0) {
        // Fringes at both ends.
        const unsigned fringes = w.detail.grow(6, 0.7, 60);
        const double pitch = depth / fringes;
        for (unsigned i = 0; i < fringes; ++i) {
            const double z = -0.5 * depth + (i + 0.3) * pitch;
            w.solids.addBox({-0.5 * width - 0.06, 0.0, z}, {-0.5 * width, 0.006, z + 0.4 * pitch});
            w.solids.addBox({0.5 * width, 0.0, z}, {0.5 * width + 0.06, 0.006, z + 0.4 * pitch});
        }
    }
    w.solids.finish("rug", cloth);
}

}  // namespace fluxwalk::scene::building
