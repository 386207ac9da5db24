#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/scene/building_furniture.h"

namespace fluxwalk::scene::building {

namespace {

unsigned segmentsOf(const Workshop& w) {
    return 2 * w.detail.grow(3, 0.5);
}

// Rings of a vessel's wall: outside along `radius` of the height, back inside of it. The inside follows the
// outside as it is drawn, so that coarse rings do not pierce it.
template <class Radius>
std::vector<LatheRing> vesselRings(const Workshop& w, double height, double thickness, Radius radius) {
    const unsigned rings = w.detail.grow(1, 0.5);
    std::vector<LatheRing> profile;
    for (unsigned i = 0; i <= rings; ++i) {
        const double t = static_cast<double>(i) / rings;
        profile.push_back({radius(t), height * t});
    }
    const double bottom = thickness / height;
    for (unsigned i = 0; i <= rings; ++i) {
        const double t = 1.0 - (1.0 - bottom) * i / rings;
        const auto below = std::min(static_cast<unsigned>(t * rings), rings - 1);
        const double part = t * rings - below;
        const double outside = (1.0 - part) * profile[below].radius + part * profile[below + 1].radius;
        profile.push_back({outside - thickness, height * t});
    }
    return profile;
}

}  // namespace

void addScreen(Workshop& w, const Placement& at, double width) {
    const double half = 0.5 * width;
    const double height = 0.58 * width;
    w.solids.setPlacement(at);
    w.solids.addBox({-0.12, 0.0, -0.1}, {0.12, 0.012, 0.1});
    w.solids.addBox({-0.025, 0.012, -0.06}, {0.025, 0.2, -0.04});
    w.solids.addBox({-half, 0.1, -0.04}, {half, 0.1 + height, -0.01});
    w.solids.finish("screen", w.palette.black);
}

void addKeyboard(Workshop& w, const Placement& at) {
    constexpr double kHalf = 0.21;
    w.solids.setPlacement(at);
    w.solids.addBox({-kHalf, 0.0, -0.065}, {kHalf, 0.016, 0.065});
    w.solids.finish("keyboard", w.palette.black);
    if (w.detail.level < 1.5) {
        return;
    }
    const unsigned columns = w.detail.grow(4, 0.7, 16);
    const unsigned rows = w.detail.grow(2, 0.6, 6);
    const double px = (2.0 * kHalf - 0.02) / columns;
    const double pz = 0.11 / rows;
    for (unsigned j = 0; j < rows; ++j) {
        for (unsigned i = 0; i < columns; ++i) {
            const double x = -kHalf + 0.01 + i * px;
            const double z = -0.055 + j * pz;
            w.solids.addBox({x + 0.1 * px, 0.016, z + 0.1 * pz}, {x + 0.9 * px, 0.024, z + 0.9 * pz});
        }
    }
    w.solids.finish("keys", w.palette.metal);
}

void addMug(Workshop& w, const Placement& at, std::uint32_t colour) {
    w.solids.setPlacement(at);
    w.solids.addTurned(Vec3d(0.0), vesselRings(w, 0.095, 0.008, [](double) { return 0.041; }), segmentsOf(w));
    w.solids.addBox({0.04, 0.02, -0.005}, {0.065, 0.075, 0.005});
    w.solids.finish("mug", colour);
}

void addBowl(Workshop& w, const Placement& at, double radius, std::uint32_t colour) {
    w.solids.setPlacement(at);
    const auto rings = vesselRings(w, 0.55 * radius, 0.1 * radius,
                                   [radius](double t) { return radius * (0.5 + 0.5 * std::sqrt(t)); });
    w.solids.addTurned(Vec3d(0.0), rings, segmentsOf(w));
    w.solids.finish("bowl", colour);
}

void addBottle(Workshop& w, const Placement& at, double height, std::uint32_t colour) {
    const unsigned more = w.detail.grow(1, 0.5);
    std::vector<LatheRing> rings{{0.036, 0.0}};
    for (unsigned i = 0; i <= more; ++i) {
        const double t = static_cast<double>(i) / more;
        const double s = t * t * (3.0 - 2.0 * t);
        rings.push_back({0.036 + s * (0.013 - 0.036), height * (0.6 + 0.22 * t)});
    }
    rings.push_back({0.013, height});
    w.solids.setPlacement(at);
    w.solids.addTurned(Vec3d(0.0), rings, segmentsOf(w));
    w.solids.finish("bottle", colour);
}

void addPaper(Workshop& w, const Placement& at) {
    w.solids.setPlacement(at);
    w.solids.addBox({-0.105, 0.0, -0.148}, {0.105, 0.012, 0.148});
    w.solids.finish("papers", w.palette.paper);
}

void addPlant(Workshop& w, const Placement& at, double height, std::uint64_t key) {
    const double pot = 0.3 * height;
    w.solids.setPlacement(at);
    const auto rings = vesselRings(w, pot, 0.12 * pot, [pot](double t) { return pot * (0.36 + 0.14 * t); });
    w.solids.addTurned(Vec3d(0.0), rings, segmentsOf(w));
    w.solids.finish("plant pot", w.palette.clay);
    base::RandomStream random(key);
    const unsigned leaves = w.detail.grow(6, 0.75);
    for (unsigned i = 0; i < leaves; ++i) {
        // Leaves are flat double pyramids around a rib that bends outwards.
        const double turn = 2.0 * base::kPi * (0.618034 * i + 0.05 * random.next());
        const double rise = 0.6 + 0.38 * random.next();
        const double length = height * (0.35 + 0.2 * random.next());
        const Vec3d level(std::cos(turn), 0.0, std::sin(turn));
        const Vec3d across(-level.z, 0.0, level.x);
        const Vec3d along = glm::normalize((1.0 - rise) * level + Vec3d(0.0, 1.25 * rise, 0.0));
        const Vec3d normal = glm::cross(across, along);
        const Vec3d foot = Vec3d(0.0, 0.14 * pot, 0.0) + 0.06 * pot * (1.0 + random.next()) * level;
        const Vec3d tip = foot + length * along + 0.1 * length * (level - Vec3d(0.0, 1.5, 0.0));
        const Vec3d middle = foot + 0.62 * length * along;
        const double width = 0.11 * length + 0.02;
        const Vec3d left = middle - width * across;
        const Vec3d right = middle + width * across;
        const Vec3d upper = middle + 0.012 * normal;
        const Vec3d lower = middle - 0.012 * normal;
        for (const auto& [a, b] : {std::pair{foot, right}, {right, tip}, {tip, left}, {left, foot}}) {
            w.solids.addTriangle(a, b, upper);
            w.solids.addTriangle(b, a, lower);
        }
        if (i % 10 == 9 || i + 1 == leaves) {
            w.solids.finish("leaves", w.palette.leaf);
        }
    }
}

void addBin(Workshop& w, const Placement& at) {
    w.solids.setPlacement(at);
    w.solids.addTurned(Vec3d(0.0), vesselRings(w, 0.3, 0.01, [](double t) { return 0.11 + 0.03 * t; }),
                       segmentsOf(w));
    w.solids.finish("waste bin", w.palette.metal);
}

void addBooks(Workshop& w, const Placement& at, double from, double to, double room, std::uint64_t key) {
    // Thick blocks become single volumes as the level rises, and these get covers.
    const double thickness = std::max(0.02, 0.16 / w.detail.level);
    const auto count = static_cast<unsigned>(std::clamp((to - from) / (1.15 * thickness), 1.0, 60.0));
    const double pitch = (to - from) / count;
    const bool hasCovers = w.detail.level >= 8.0;
    w.solids.setPlacement(at);
    constexpr unsigned kPerObject = 8;
    double x = from;
    for (unsigned i = 0; i < count; ++i) {
        base::RandomStream random(base::combine(key, i));
        const double wide = pitch * (0.75 + 0.25 * random.next());
        const double height = room * (0.6 + 0.3 * random.next());
        const double depth = 0.15 + 0.09 * random.next();
        if (hasCovers) {
            const double cover = 0.15 * wide;
            const double end = x + wide;
            w.solids.addBox({x, 0.0, 0.0}, {x + cover, height, depth});
            w.solids.addBox({end - cover, 0.0, 0.0}, {end, height - 0.0005, depth - 0.0005});
            w.solids.addBox({x + cover, 0.005, 0.004}, {end - cover, height - 0.005, depth - 0.003});
        } else {
            w.solids.addBox({x, 0.0, 0.0}, {x + wide, height, depth});
        }
        // Books stand in groups of one colour; here and there one is missing.
        x += wide;
        if ((i + 1) % kPerObject == 0 || i + 1 == count) {
            base::RandomStream colour(base::combine(key, 1000 + i / kPerObject));
            w.solids.finish("books", w.palette.colours[static_cast<std::size_t>(8.0 * colour.next())]);
            x += 0.02;
        }
    }
}

void addPicture(Workshop& w, const Placement& at, double width, double height, std::uint32_t colour) {
    constexpr double kFrame = 0.03;
    const double x = 0.5 * width;
    const double y = 0.5 * height;
    w.solids.setPlacement(at);
    w.solids.addBox({-x, -y, 0.0}, {-x + kFrame, y, 0.03});
    w.solids.addBox({x - kFrame, -y, 0.0}, {x, y, 0.03});
    w.solids.addBox({-x + kFrame, -y, 0.0}, {x - kFrame, -y + kFrame, 0.026});
    w.solids.addBox({-x + kFrame, y - kFrame, 0.0}, {x - kFrame, y, 0.026});
    w.solids.finish("picture frame", w.palette.black);
    w.solids.addBox({-x + kFrame, -y + kFrame, 0.0}, {x - kFrame, y - kFrame, 0.02});
    w.solids.finish("picture", colour);
}

void addRadiator(Workshop& w, const Placement& at, double width) {
    const unsigned fins = w.detail.grow(3, 0.7, static_cast<unsigned>(width / 0.04));
    const double pitch = width / fins;
    w.solids.setPlacement(at);
    for (unsigned i = 0; i < fins; ++i) {
        const double x = -0.5 * width + i * pitch;
        w.solids.addBox({x, 0.12, 0.03}, {x + 0.7 * pitch, 0.72, 0.11});
    }
    for (unsigned i = 0; i + 1 < fins; ++i) {
        const double x = -0.5 * width + (i + 0.7) * pitch;
        w.solids.addBox({x, 0.16, 0.05}, {x + 0.3 * pitch, 0.2, 0.09});
        w.solids.addBox({x, 0.64, 0.05}, {x + 0.3 * pitch, 0.68, 0.09});
    }
    w.solids.finish("radiator", w.palette.white);
}

void addBlinds(Workshop& w, const Placement& at, const Opening& window, double part) {
    const double fall = part * (window.top - window.bottom);
    const unsigned slats = w.detail.grow(4, 0.8, 45);
    const double pitch = fall / slats;
    const double z = kRoomDepth + 0.05;
    w.solids.setPlacement(at);
    w.solids.addBox({window.from + 0.01, window.top - 0.05, z - 0.03},
                    {window.to - 0.01, window.top, z + 0.03});
    w.solids.finish("blind rail", w.palette.metal);
    for (unsigned i = 0; i < slats; ++i) {
        const double y = window.top - 0.06 - (i + 1) * (fall - 0.06) / slats;
        const double deep = std::min(0.035, 0.5 * pitch);
        w.solids.addBox({window.from + 0.02, y, z - deep}, {window.to - 0.02, y + 0.008, z + deep});
        if (i % 8 == 7 || i + 1 == slats) {
            w.solids.finish("blind slats", w.palette.paper);
        }
    }
}

void addCurtains(Workshop& w, const Placement& at, const Opening& window, std::uint32_t cloth) {
    const unsigned waves = w.detail.grow(2, 0.5, 9);
    const unsigned steps = 2 * std::max(2u, w.detail.grow(1, 0.5));
    const double z = kRoomDepth - 0.16;
    w.solids.setPlacement(at);
    for (const double side : {-1.0, 1.0}) {
        const double outer = side < 0.0 ? window.from - 0.15 : window.to - 0.35;
        std::vector<Vec2d> line;
        const unsigned points = waves * steps;
        for (unsigned i = 0; i <= points; ++i) {
            const double t = static_cast<double>(i) / points;
            line.emplace_back(outer + 0.5 * t, z + 0.04 * std::sin(2.0 * base::kPi * (waves * t + 0.15)));
        }
        w.solids.addBand(line, 0.012, 0.06, 2.5);
    }
    w.solids.finish("curtains", cloth);
    w.solids.addBox({window.from - 0.25, 2.5, z - 0.02}, {window.to + 0.25, 2.53, z + 0.01});
    w.solids.finish("curtain rail", w.palette.steel);
}

}  // namespace fluxwalk::scene::building
