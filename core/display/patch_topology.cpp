#include "core/display/patch_topology.h"

#include <bit>
#include <cmath>
#include <unordered_map>

#include "core/base/random.h"
#include "core/surface/region.h"

namespace fluxwalk::display {

namespace {

/// How far a corner may lie off the middle of an edge that it cuts, relative to the largest coordinate: a few
/// roundings of float input.
constexpr double kCutTolerance = 2e-6;

struct PositionHash {
    std::size_t operator()(const Vec3d& p) const {
        std::uint64_t key = 0;
        for (int i = 0; i < 3; ++i) {
            key = base::combine(key, std::bit_cast<std::uint64_t>(p[i]));
        }
        return static_cast<std::size_t>(key);
    }
};

// Minus zero becomes zero: both are one place.
Vec3d canonical(const Vec3d& p) {
    return p + Vec3d(0.0);
}

}  // namespace

/// Numbers corners and edges as patches come.
class PatchTopology::Builder {
  public:
    explicit Builder(PatchTopology& topology) : topology_(topology) {}

    void addPatch(std::uint32_t patch) {
        const surface::Surface& surface = topology_.surface_;
        const surface::Region whole = surface::wholePatch(surface.domain(patch));
        Patch& q = topology_.patches_[patch];
        q.cornerCount = whole.cornerCount;
        std::array<std::uint32_t, 4> corner{};
        for (std::uint32_t i = 0; i < q.cornerCount; ++i) {
            corner[i] = addCorner(canonical(surface.evaluate(patch, whole.corners[i]).position));
            for (unsigned set = 0; set < 2; ++set) {
                topology_.hasTexcoords_[set] = topology_.hasTexcoords_[set] ||
                                               surface.texcoord(patch, whole.corners[i], set) != Vec2d(0.0);
            }
        }
        const bool straight = surface.isPlanar(patch);
        for (std::uint32_t i = 0; i < q.cornerCount; ++i) {
            const std::uint32_t j = (i + 1) % q.cornerCount;
            const Vec2d split = surface.splitPoint(patch, whole.corners[i], whole.corners[j]);
            const Vec3d middle = straight
                                     ? 0.5 * (topology_.corners_[corner[i]] + topology_.corners_[corner[j]])
                                     : surface.evaluate(patch, split).position;
            q.sides[i] = addEdge(corner[i], corner[j], canonical(middle), straight);
            if (++topology_.edges_[q.sides[i].edge].patchCount == 1 && !straight) {
                const auto between = [&](const Vec2d& a, const Vec2d& b) {
                    return canonical(surface.evaluate(patch, surface.splitPoint(patch, a, b)).position);
                };
                quartersOf_[q.sides[i].edge] = {between(whole.corners[i], split),
                                                between(split, whole.corners[j])};
            }
        }
    }

    void cutFreeEdges() {
        const base::Box box = cornerBox();
        const double largest = std::max(glm::length(box.lower), glm::length(box.upper));
        const double tolerance = kCutTolerance * largest;
        // Edges appended by cuts are looked at too.
        // NOLINTNEXTLINE(modernize-loop-convert): the vector grows
        for (std::uint32_t e = 0; e < topology_.edges_.size(); ++e) {
            const Edge edge = topology_.edges_[e];
            const Vec3d from = topology_.corners_[edge.from];
            const Vec3d to = topology_.corners_[edge.to];
            if (!edge.straight) {
                cutCurved(e);
                continue;
            }
            if (edge.patchCount > 1 || glm::distance(from, to) < 16.0 * tolerance) {
                continue;
            }
            const std::uint32_t corner = cornerNear(edge.middle, tolerance);
            if (corner == kNone) {
                continue;
            }
            const Vec3d& cut = topology_.corners_[corner];
            const EdgeUse first = addEdge(edge.from, corner, canonical(0.5 * (from + cut)), true);
            const EdgeUse second = addEdge(corner, edge.to, canonical(0.5 * (cut + to)), true);
            topology_.edges_[e].middleCorner = corner;
            topology_.edges_[e].halves = {first, second};
        }
    }

  private:
    // A curved edge is cut where its middle is a corner, as of subdivision surfaces next to faces of other
    // than four corners.
    void cutCurved(std::uint32_t e) {
        const Edge edge = topology_.edges_[e];
        const auto corner = cornerOf_.find(edge.middle);
        const auto quarters = quartersOf_.find(e);
        if (edge.patchCount != 1 || corner == cornerOf_.end() || quarters == quartersOf_.end()) {
            return;
        }
        const EdgeUse first = addEdge(edge.from, corner->second, quarters->second[0], false);
        const EdgeUse second = addEdge(corner->second, edge.to, quarters->second[1], false);
        topology_.edges_[e].middleCorner = corner->second;
        topology_.edges_[e].halves = {first, second};
    }

    std::uint32_t addCorner(const Vec3d& position) {
        const auto number = static_cast<std::uint32_t>(topology_.corners_.size());
        const auto [it, isNew] = cornerOf_.try_emplace(position, number);
        if (isNew) {
            topology_.corners_.push_back(position);
        }
        return it->second;
    }

    EdgeUse addEdge(std::uint32_t from, std::uint32_t to, const Vec3d& middle, bool straight) {
        auto& edges = topology_.edges_;
        const auto number = static_cast<std::uint32_t>(edges.size());
        const std::uint64_t ends =
            (static_cast<std::uint64_t>(std::min(from, to)) << 32) | std::max(from, to);
        const auto [it, isNew] = edgeOf_.try_emplace(ends, number);
        // An edge that begins where it ends has no direction to be recognised by: it is never shared.
        if (!isNew && from != to) {
            for (std::uint32_t e = it->second; e != kNone; e = edges[e].nextWithSameEnds) {
                if (edges[e].middle == middle) {
                    return {e, edges[e].from != from};
                }
            }
        }
        Edge edge;
        edge.from = from;
        edge.to = to;
        edge.middle = middle;
        edge.straight = straight;
        edge.nextWithSameEnds = isNew ? kNone : it->second;
        it->second = number;
        edges.push_back(edge);
        return {number, false};
    }

    base::Box cornerBox() const {
        base::Box box;
        for (const Vec3d& c : topology_.corners_) {
            box.extend(c);
        }
        return box;
    }

    // A hash grid over the corners, made when first asked for: closed meshes never do.
    std::uint32_t cornerNear(const Vec3d& p, double tolerance) {
        const double cellSize = 8.0 * tolerance;
        const auto cellKey = [](const glm::i64vec3& c) {
            return base::combine(
                base::combine(static_cast<std::uint64_t>(c.x), static_cast<std::uint64_t>(c.y)),
                static_cast<std::uint64_t>(c.z));
        };
        if (nextInCell_.empty()) {
            nextInCell_.resize(topology_.corners_.size(), kNone);
            firstInCell_.reserve(topology_.corners_.size());
            for (std::uint32_t i = 0; i < topology_.corners_.size(); ++i) {
                const auto cell = glm::i64vec3(glm::floor(topology_.corners_[i] / cellSize));
                const auto [it, isNew] = firstInCell_.try_emplace(cellKey(cell), i);
                nextInCell_[i] = isNew ? kNone : it->second;
                it->second = i;
            }
        }
        const auto low = glm::i64vec3(glm::floor((p - Vec3d(tolerance)) / cellSize));
        const auto high = glm::i64vec3(glm::floor((p + Vec3d(tolerance)) / cellSize));
        std::uint32_t best = kNone;
        double nearest = tolerance;
        glm::i64vec3 c;
        for (c.x = low.x; c.x <= high.x; ++c.x) {
            for (c.y = low.y; c.y <= high.y; ++c.y) {
                for (c.z = low.z; c.z <= high.z; ++c.z) {
                    const auto it = firstInCell_.find(cellKey(c));
                    std::uint32_t i = it == firstInCell_.end() ? kNone : it->second;
                    for (; i != kNone; i = nextInCell_[i]) {
                        const double distance = glm::distance(topology_.corners_[i], p);
                        if (distance < nearest || (distance == nearest && i < best)) {
                            nearest = distance;
                            best = i;
                        }
                    }
                }
            }
        }
        return best;
    }

    PatchTopology& topology_;
    std::unordered_map<Vec3d, std::uint32_t, PositionHash> cornerOf_;
    std::unordered_map<std::uint64_t, std::uint32_t> edgeOf_;
    /// Middles of the halves of curved edges.
    std::unordered_map<std::uint32_t, std::array<Vec3d, 2>> quartersOf_;
    std::unordered_map<std::uint64_t, std::uint32_t> firstInCell_;
    std::vector<std::uint32_t> nextInCell_;
};

PatchTopology::PatchTopology(const surface::Surface& surface) : surface_(surface) {
    patches_.resize(surface.patchCount());
    Builder builder(*this);
    for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
        builder.addPatch(patch);
    }
    builder.cutFreeEdges();
}

PointKey PatchTopology::keyOnSide(const Patch& patch, std::uint32_t side, std::uint64_t t) const {
    EdgeUse use = patch.sides[side];
    for (;;) {
        const Edge& edge = edges_[use.edge];
        if (use.reversed) {
            t = kGridSize - t;
        }
        if (t == 0 || t == kGridSize) {
            return {t == 0 ? edge.from : edge.to, kCornerKey};
        }
        if (edge.middleCorner == kNone) {
            return {t, kEdgeKey | use.edge};
        }
        if (2 * t == kGridSize) {
            return {edge.middleCorner, kCornerKey};
        }
        const bool second = 2 * t > kGridSize;
        use = edge.halves[second ? 1 : 0];
        t = second ? 2 * t - kGridSize : 2 * t;
    }
}

}  // namespace fluxwalk::display
