#include "core/base/photometry.h"
#include "core/scene/building_furniture.h"

namespace fluxwalk::scene::building {

namespace {

// A bulb in a shade of which both ends are open.
void addShade(Workshop& w, double height, double mouth, double crown, double tall) {
    w.solids.placeCone("lampshade", w.palette.shade, {0.0, height, 0.0}, mouth, crown, tall);
    w.solids.placeSphere("bulb", w.palette.bulbLight, {0.0, height + 0.45 * tall, 0.0}, kBulbRadius);
}

}  // namespace

// The housing is a box without its lower face, which the panel is.
void addPanel(Workshop& w, const Placement& at) {
    constexpr double kDrop = 0.07;
    const double x = 0.5 * kPanelLength;
    const double z = 0.5 * kPanelWidth;
    const std::array<Vec3d, 4> low{Vec3d{-x, -kDrop, z}, {x, -kDrop, z}, {x, -kDrop, -z}, {-x, -kDrop, -z}};
    const std::array<Vec3d, 4> high{Vec3d{-x, 0.0, z}, {x, 0.0, z}, {x, 0.0, -z}, {-x, 0.0, -z}};
    w.solids.setPlacement(at);
    w.solids.addQuad(high[0], high[1], high[2], high[3]);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        w.solids.addQuad(low[i], low[next], high[next], high[i]);
    }
    w.solids.finish("panel housing", w.palette.metal);
    w.solids.addQuad(low[3], low[2], low[1], low[0]);
    w.solids.finish("panel", w.palette.panelLight);
    if (w.detail.level >= 2.0) {
        // Louvres hang below the panel from two bars beside it.
        const unsigned louvres = w.detail.grow(4, 0.6, 40);
        const double pitch = kPanelLength / louvres;
        for (const double side : {-z - 0.02, z}) {
            w.solids.addBox({-x, -kDrop - 0.06, side}, {x, -kDrop + 0.03, side + 0.02});
        }
        for (unsigned i = 0; i < louvres; ++i) {
            const double middle = -x + (i + 0.5) * pitch;
            w.solids.addBox({middle - 0.005, -kDrop - 0.055, -z}, {middle + 0.005, -kDrop - 0.015, z});
        }
        w.solids.finish("louvres", w.palette.white);
    }
}

void addGlobe(Workshop& w, const Placement& at, double cord) {
    w.solids.setPlacement(at);
    // Between the rose and a cap that stops short of the globe: no emitter lies against a solid.
    w.solids.addBox({-0.05, -0.02, -0.05}, {0.05, 0.0, 0.05});
    w.solids.addBox({-0.008, -cord, -0.008}, {0.008, -0.02, 0.008});
    w.solids.addBox({-0.03, -cord - 0.03, -0.03}, {0.03, -cord, 0.03});
    w.solids.finish("cord", w.palette.black);
    const double center = -cord - 0.04 - kGlobeRadius;
    w.solids.placeSphere("globe", w.palette.globeLight, {0.0, center, 0.0}, kGlobeRadius);
    w.solids.placeTorus("globe ring", w.palette.steel, {0.0, center, 0.0}, kGlobeRadius + 0.05, 0.012);
}

void addPendant(Workshop& w, const Placement& at, double cord) {
    constexpr double kTall = 0.2;
    constexpr double kCrown = 0.05;
    w.solids.setPlacement(at);
    w.solids.addBox({-0.04, -0.02, -0.04}, {0.04, 0.0, 0.04});
    w.solids.addBox({-0.008, -cord, -0.008}, {0.008, -0.02, 0.008});
    // Bars that carry the shade.
    w.solids.addBox({-kCrown, -cord - 0.01, -0.009}, {kCrown, -cord, 0.009});
    w.solids.finish("cord", w.palette.black);
    addShade(w, -cord - 0.005 - kTall, 0.21, kCrown, kTall);
}

void addStandLamp(Workshop& w, const Placement& at, double height) {
    constexpr double kTall = 0.22;
    const double foot = 0.045 + 0.06 * height;
    const double stem = height - kTall + 0.03;
    const std::array<LatheRing, 5> rings{
        LatheRing{foot, 0.0}, {foot, 0.02}, {0.012, 0.035}, {0.012, stem - 0.03}, {0.02, stem}};
    w.solids.setPlacement(at);
    w.solids.addTurned(Vec3d(0.0), rings, 2 * w.detail.grow(3, 0.5));
    w.solids.finish("lamp stand", w.palette.steel);
    addShade(w, height - kTall, 0.1 + 0.06 * height, 0.07 + 0.03 * height, kTall);
}

}  // namespace fluxwalk::scene::building
