#include "core/display/sample_net.h"

#include <algorithm>

namespace fluxwalk::display {

using surface::Region;

void SampleNet::reset(const PatchTopology& topology, const MeshVertices& mesh) {
    topology_ = &topology;
    surface_ = &topology.surface();
    samples_.clear();
    edges_.clear();
    pointCount_ = static_cast<std::uint32_t>(mesh.positions.size());
    sampleOfVertex_.assign(mesh.vertices.size(), kNone);
    rootMiddles_ = PointTable(2 * mesh.cells.size());
    firstRoot_.clear();
    roots_.clear();
}

std::uint32_t SampleNet::addSample(std::uint32_t patch, const Vec2d& uv) {
    samples_.push_back(sampleAt(*surface_, patch, uv));
    return static_cast<std::uint32_t>(samples_.size() - 1);
}

std::uint32_t SampleNet::addEdge(bool isBorder) {
    edges_.emplace_back().isBorder = isBorder;
    return static_cast<std::uint32_t>(edges_.size() - 1);
}

// Edges run from the end with the lower number. One that ends where it begins, as at a pole, is never shared
// between patches (PatchTopology).
std::uint32_t SampleNet::rootUse(std::uint32_t patch, const GridPoint& a, const GridPoint& b,
                                 std::uint32_t from, std::uint32_t to) {
    const PointKey key = topology_->keyOf(patch, display::middleOf(a, b));
    const std::uint32_t number = rootMiddles_.insert(key);
    if (number == firstRoot_.size()) {
        firstRoot_.push_back(kNone);
    }
    const std::array<std::uint32_t, 2> ends =
        from == to ? std::array{kNone, patch} : std::array{std::min(from, to), std::max(from, to)};
    std::uint32_t root = firstRoot_[number];
    while (root != kNone && roots_[root].ends != ends) {
        root = roots_[root].next;
    }
    if (root == kNone) {
        root = static_cast<std::uint32_t>(roots_.size());
        roots_.push_back({ends, addEdge(!PatchTopology::isInside(key)), firstRoot_[number]});
        firstRoot_[number] = root;
    }
    return 2 * roots_[root].edge + (from > to ? 1 : 0);
}

CellNet SampleNet::addRoot(const Cell& cell, const CellVertices& own, const Region& region) {
    CellNet net;
    std::array<std::uint32_t, 4> points{};
    for (unsigned k = 0; k < cell.cornerCount; ++k) {
        const std::uint32_t vertex = own.corners[k];
        std::uint32_t sample = sampleOfVertex_[vertex];
        while (sample != kNone && samples_[sample].uv != region.corners[k]) {
            sample = samples_[sample].next;
        }
        points[k] = cell.points[k];
        if (sample == kNone) {
            sample = addSample(cell.patch, region.corners[k]);
            samples_[sample].point = points[k];
            samples_[sample].next = sampleOfVertex_[vertex];
            sampleOfVertex_[vertex] = sample;
        }
        net.corners[k] = sample;
    }
    if (cell.cornerCount == 3) {
        net.corners[3] = net.corners[2];
    }
    const std::array<GridPoint, 4> corners = cornersOf(cell);
    for (unsigned k = 0; k < cell.cornerCount; ++k) {
        const unsigned next = k + 1u == cell.cornerCount ? 0 : k + 1;
        net.sides[k] = rootUse(cell.patch, corners[k], corners[next], points[k], points[next]);
        const std::uint32_t point = cell.middles[k];
        if (point != kNone && !isSplit(net.sides[k])) {
            const GridPoint middle = display::middleOf(corners[k], corners[next]);
            const std::uint32_t first = rootUse(cell.patch, corners[k], middle, points[k], point);
            const std::uint32_t second = rootUse(cell.patch, middle, corners[next], point, points[next]);
            Edge& edge = edges_[net.sides[k] / 2];
            edge.point = point;
            edge.halves =
                net.sides[k] % 2 == 0 ? std::array{first, second} : std::array{second ^ 1u, first ^ 1u};
        }
    }
    return net;
}

std::uint32_t SampleNet::middleOf(const CellNet& net, unsigned side, unsigned cornerCount) {
    const std::uint32_t number = net.sides[side] / 2;
    const Edge& edge = edges_[number];
    if (!edge.isBorder && edge.sample != kNone) {
        return edge.sample;
    }
    const SurfaceSample& from = samples_[net.corners[side]];
    const SurfaceSample& to = samples_[net.corners[side + 1 == cornerCount ? 0 : side + 1]];
    const std::uint32_t patch = from.patch;
    const Vec2d uv = surface_->splitPoint(patch, from.uv, to.uv);
    for (std::uint32_t s = edge.sample; s != kNone; s = samples_[s].next) {
        if (samples_[s].patch == patch && samples_[s].uv == uv) {
            return s;
        }
    }
    const std::uint32_t sample = addSample(patch, uv);
    samples_[sample].next = edge.sample;
    samples_[sample].point = edge.point;
    edges_[number].sample = sample;
    return sample;
}

std::uint32_t SampleNet::centerOf(CellNet& net) {
    if (net.center == kNone) {
        const Vec2d left = samples_[middleOf(net, 3, 4)].uv;
        const Vec2d right = samples_[middleOf(net, 1, 4)].uv;
        const std::uint32_t patch = samples_[net.corners[0]].patch;
        net.center = addSample(patch, surface_->splitPoint(patch, left, right));
    }
    return net.center;
}

void SampleNet::split(std::uint32_t edge) {
    if (edges_[edge].halves[0] == kNone) {
        const bool isBorder = edges_[edge].isBorder;
        const std::uint32_t first = addEdge(isBorder);
        const std::uint32_t second = addEdge(isBorder);
        edges_[edge].halves = {2 * first, 2 * second};
        edges_[edge].point = pointCount_++;
    }
}

std::uint32_t SampleNet::splitSide(const CellNet& net, unsigned side, unsigned cornerCount) {
    split(net.sides[side] / 2);
    return vertexOn(net, side, cornerCount);
}

std::uint32_t SampleNet::vertexOn(const CellNet& net, unsigned side, unsigned cornerCount) {
    const std::uint32_t sample = middleOf(net, side, cornerCount);
    samples_[sample].point = edges_[net.sides[side] / 2].point;
    return sample;
}

// What lies in the middle of the cell lies in the middle of its edges inside, except where surfaces split
// edges elsewhere.
std::uint32_t SampleNet::addInnerEdge(std::uint32_t from, std::uint32_t to, std::uint32_t middle) {
    const std::uint32_t edge = addEdge(false);
    if (middle != kNone && samples_[middle].uv == surface_->splitPoint(samples_[from].patch,
                                                                       samples_[from].uv, samples_[to].uv)) {
        edges_[edge].sample = middle;
    }
    return 2 * edge;
}

std::array<CellNet, 2> SampleNet::halve(CellNet& net, Axis axis) {
    const auto& c = net.corners;
    const auto& s = net.sides;
    if (axis == Axis::x) {
        const std::uint32_t e0 = splitSide(net, 0, 4);
        const std::uint32_t e2 = splitSide(net, 2, 4);
        const std::uint32_t inner = addInnerEdge(e0, e2, net.center);
        return {CellNet{{c[0], e0, e2, c[3]}, {halfOf(s[0], 0), inner, halfOf(s[2], 1), s[3]}},
                CellNet{{e0, c[1], c[2], e2}, {halfOf(s[0], 1), s[1], halfOf(s[2], 0), inner ^ 1u}}};
    }
    const std::uint32_t e1 = splitSide(net, 1, 4);
    const std::uint32_t e3 = splitSide(net, 3, 4);
    const std::uint32_t inner = addInnerEdge(e3, e1, net.center);
    return {CellNet{{c[0], c[1], e1, e3}, {s[0], halfOf(s[1], 0), inner ^ 1u, halfOf(s[3], 1)}},
            CellNet{{e3, e1, c[2], c[3]}, {inner, halfOf(s[1], 1), s[2], halfOf(s[3], 0)}}};
}

void SampleNet::splitBetween(const CellNet& firstHalf, Axis axis) {
    split(firstHalf.sides[axis == Axis::x ? 1 : 2] / 2);
}

std::array<CellNet, 4> SampleNet::quarter(CellNet& net) {
    const auto& c = net.corners;
    const auto& s = net.sides;
    const std::uint32_t ab = splitSide(net, 0, 3);
    const std::uint32_t bc = splitSide(net, 1, 3);
    const std::uint32_t ca = splitSide(net, 2, 3);
    const std::uint32_t atA = addInnerEdge(ab, ca, kNone);
    const std::uint32_t atB = addInnerEdge(bc, ab, kNone);
    const std::uint32_t atC = addInnerEdge(ca, bc, kNone);
    return {CellNet{{c[0], ab, ca, ca}, {halfOf(s[0], 0), atA, halfOf(s[2], 1)}},
            CellNet{{ab, c[1], bc, bc}, {halfOf(s[0], 1), halfOf(s[1], 0), atB}},
            CellNet{{ca, bc, c[2], c[2]}, {atC, halfOf(s[1], 1), halfOf(s[2], 0)}},
            CellNet{{bc, ca, ab, ab}, {atC ^ 1u, atA ^ 1u, atB ^ 1u}}};
}

Region SampleNet::regionOf(const CellNet& net, unsigned cornerCount) const {
    Region region;
    region.cornerCount = cornerCount;
    for (unsigned k = 0; k < 4; ++k) {
        region.corners[k] = samples_[net.corners[k]].uv;
    }
    return region;
}

}  // namespace fluxwalk::display
