#include <algorithm>

#include "core/base/check.h"
#include "core/scene/building.h"

namespace fluxwalk::scene::building {

namespace {

/// Set-back of what stands between posts, in metres.
constexpr double kStep = 0.004;

/// One of the four walls: the lines of its inner and outer face, and how it runs along them.
struct WallLine {
    bool isAcross = false;  ///< runs along z
    double inner = 0.0;
    double outer = 0.0;
    double innerFrom = 0.0;
    double innerTo = 0.0;
    double outerFrom = 0.0;
    double outerTo = 0.0;

    Vec2d point(double along, double across) const {
        return isAcross ? Vec2d(across, along) : Vec2d(along, across);
    }
};

WallLine lineOf(const Cell& cell, unsigned side) {
    const auto& t = cell.thickness;
    if (side < 2) {
        const double inner = side == 0 ? 0.0 : cell.width;
        return {
            true, inner, side == 0 ? -t[0] : cell.width + t[1], 0.0, cell.depth, -t[2], cell.depth + t[3]};
    }
    const double inner = side == 2 ? 0.0 : cell.depth;
    return {false, inner, side == 2 ? -t[2] : cell.depth + t[3], 0.0, cell.width, -t[0], cell.width + t[1]};
}

}  // namespace

// Pieces meet at mitred corners, so that a wall's inner face is what the room sees of it; each wall is a mesh
// of its own.
void addWalls(Workshop& w, const Placement& at, const Cell& cell, double bottom, double top) {
    w.solids.setPlacement(at);
    for (unsigned side = 0; side < 4; ++side) {
        if (cell.thickness[side] == 0.0) {
            continue;
        }
        const WallLine line = lineOf(cell, side);
        const auto addPiece = [&](Vec2d from, Vec2d to, double y0, double y1) {
            // Places along the inner and the outer face.
            const std::array plan{line.point(from.x, line.inner), line.point(to.x, line.inner),
                                  line.point(to.y, line.outer), line.point(from.y, line.outer)};
            w.solids.addPrism(plan, y0, y1);
        };
        Vec2d from(line.innerFrom, line.outerFrom);
        for (const Opening& opening : cell.openings[side]) {
            addPiece(from, Vec2d(opening.from), bottom, top);
            from = Vec2d(opening.to);
        }
        addPiece(from, {line.innerTo, line.outerTo}, bottom, top);
        w.solids.finish("wall", cell.walls);
        // Apart from those beside, with which they share edges.
        for (const Opening& opening : cell.openings[side]) {
            if (opening.bottom > bottom) {
                addPiece(Vec2d(opening.from), Vec2d(opening.to), bottom, opening.bottom);
            }
            if (opening.top < top) {
                addPiece(Vec2d(opening.from), Vec2d(opening.to), opening.top, top);
            }
        }
        w.solids.finish("wall above or below an opening", cell.walls);
    }
}

void addCell(Workshop& w, const Placement& at, const Cell& cell) {
    const auto& t = cell.thickness;
    const std::array outer{-t[0], -t[2], cell.width + t[1], cell.depth + t[3]};
    w.solids.setPlacement(at);
    const auto addPlate = [&](double bottom, double top, bool isCeiling) {
        if (std::find(t.begin(), t.end(), 0.0) == t.end()) {
            w.solids.addFramedSlab(outer, {0.0, 0.0, cell.width, cell.depth}, bottom, top, isCeiling);
            return;
        }
        std::vector<double> xs{outer[0]};
        if (t[0] > 0.0) {
            xs.push_back(0.0);
        }
        xs.push_back(cell.width);
        if (t[1] > 0.0) {
            xs.push_back(outer[2]);
        }
        const std::array zs{outer[1], 0.0, cell.depth, outer[3]};
        w.solids.addGridSlab(xs, zs, bottom, top);
    };
    addPlate(-kFloorPlate, 0.0, false);
    w.solids.finish("floor", cell.floor);
    addPlate(kClearHeight, kClearHeight + kSlab, true);
    w.solids.finish("ceiling", w.palette.white);
    addWalls(w, at, cell, 0.0, kClearHeight);
}

void addDoor(Workshop& w, const Placement& at, double degrees, std::uint32_t wood) {
    constexpr double kJamb = 0.05;
    constexpr double kSill = 0.01;
    constexpr double kLeaf = 0.04;
    constexpr double kCorridorFace = -2.0 * kHalfWall;
    const double head = kDoorHeight - kJamb;
    w.solids.setPlacement(at);
    w.solids.addBox({kDoorFrom, 0.0, kCorridorFace}, {kDoorFrom + kJamb, kDoorHeight, 0.0});
    w.solids.addBox({kDoorTo - kJamb, 0.0, kCorridorFace}, {kDoorTo, kDoorHeight, 0.0});
    // Beside the jambs' edges: no two solids of a mesh share a whole edge, so that each has two faces.
    w.solids.addBox({kDoorFrom + kJamb, head, kCorridorFace + kStep}, {kDoorTo - kJamb, kDoorHeight, -kStep});
    w.solids.addBox({kDoorFrom + kJamb, 0.0, kCorridorFace - kStep}, {kDoorTo - kJamb, kSill, kStep});
    w.solids.finish("door frame", wood);

    // Closed, the leaf fills its frame flush with the room's face; open, it is turned about that face's edge.
    const bool isClosed = degrees == 0.0;
    const double gap = isClosed ? 0.0 : 0.01;
    const Vec3d hinge(kDoorFrom + kJamb + gap, kSill + gap, 0.0);
    const double width = kDoorTo - kDoorFrom - 2.0 * (kJamb + gap);
    const double height = head - kSill - 2.0 * gap;
    w.solids.setPlacement(at.moved(hinge, -degrees));
    w.solids.addBox({0.0, 0.0, -kLeaf}, {width, height, 0.0});
    if (w.detail.level >= 2.0) {
        // Raised panels on both faces.
        const unsigned rows = w.detail.grow(2, 0.3, 5);
        const double pitch = (height - 0.2) / rows;
        for (unsigned row = 0; row < rows; ++row) {
            for (unsigned column = 0; column < 2; ++column) {
                const double x = 0.1 + column * 0.5 * (width - 0.14);
                const double y = 0.12 + row * pitch;
                const Vec3d size(0.5 * (width - 0.14) - 0.06, pitch - 0.06, 0.012);
                w.solids.addBox({x, y, 0.0}, Vec3d(x, y, 0.0) + size);
                w.solids.addBox({x, y, -kLeaf - size.z}, Vec3d(x, y, -kLeaf) + Vec3d(size.x, size.y, 0.0));
            }
        }
    }
    w.solids.finish("door", wood);
    for (const double face : {0.0, -kLeaf - 0.05}) {
        w.solids.addBox({width - 0.09, 0.983, face}, {width - 0.075, 0.997, face + 0.05});
    }
    w.solids.addBox({width - 0.19, 0.98, 0.05}, {width - 0.07, 1.0, 0.065});
    w.solids.addBox({width - 0.19, 0.98, -kLeaf - 0.065}, {width - 0.07, 1.0, -kLeaf - 0.05});
    w.solids.finish("door handles", w.palette.steel);
}

void addWindow(Workshop& w, const Placement& at, const Opening& o) {
    constexpr double kFrame = 0.06;
    // The frame stands 15 cm behind the wall's inner face; the pane in the middle of it.
    const double near = kRoomDepth + 0.15;
    const double far = near + 0.07;
    w.solids.setPlacement(at);
    w.solids.addBox({o.from, o.bottom, near}, {o.from + kFrame, o.top, far});
    w.solids.addBox({o.to - kFrame, o.bottom, near}, {o.to, o.top, far});
    w.solids.addBox({o.from + kFrame, o.bottom, near + kStep},
                    {o.to - kFrame, o.bottom + kFrame, far - kStep});
    w.solids.addBox({o.from + kFrame, o.top - kFrame, near + kStep}, {o.to - kFrame, o.top, far - kStep});
    const unsigned fields = std::max(2u, static_cast<unsigned>((o.to - o.from) / 0.9));
    const double pitch = (o.to - o.from - 2.0 * kFrame) / fields;
    for (unsigned i = 1; i < fields; ++i) {
        const double x = o.from + kFrame + i * pitch;
        w.solids.addBox({x - 0.5 * kFrame, o.bottom + kFrame, near}, {x + 0.5 * kFrame, o.top - kFrame, far});
    }
    w.solids.finish("window frame", w.palette.white);
    for (unsigned i = 0; i < fields; ++i) {
        const double from = o.from + kFrame + i * pitch + (i > 0 ? 0.5 * kFrame : 0.0);
        const double to = o.from + kFrame + (i + 1) * pitch - (i + 1 < fields ? 0.5 * kFrame : 0.0);
        w.solids.addBox({from, o.bottom + kFrame, near + 0.02}, {to, o.top - kFrame, far - 0.02});
    }
    w.solids.finish("window panes", w.palette.pane);
    w.solids.addBox({o.from, o.bottom, kRoomDepth - 0.1}, {o.to, o.bottom + 0.03, near});
    w.solids.finish("window board", w.palette.stone);
}

}  // namespace fluxwalk::scene::building
