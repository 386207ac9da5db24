#include "core/surface/piece_tree.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/surface/region.h"
#include "core/surface/region_clip.h"
#include "core/surface/turns.h"

namespace fluxwalk::surface {

namespace {

/// Facets stray from their linear model by this part of what would make it fail to name a point, seen along
/// the normal; but pieces are quartered for it no further than this below their patch (skew ones never become
/// flat).
constexpr double kFlat = 0.2;
constexpr unsigned kMaxFacetLevels = 4;

/// Quarter of a domain that holds a parameter.
unsigned quarterAt(PatchDomain domain, const Vec2d& st) {
    if (domain == PatchDomain::quad) {
        return st.x < 0.5 ? (st.y < 0.5 ? 0 : 3) : (st.y < 0.5 ? 1 : 2);
    }
    if (st.x >= 0.5) {
        return 1;
    }
    if (st.y >= 0.5) {
        return 2;
    }
    return st.x + st.y <= 0.5 ? 0 : 3;
}

// The same quarter's coordinates of a parameter; exact for dyadic fractions.
Vec2d intoQuarter(const ParameterMap& quarter, const Vec2d& st) {
    return {(st.x - quarter.origin.x) / quarter.du.x, (st.y - quarter.origin.y) / quarter.dv.y};
}

// The quarter of a quad domain that is the only one to meet a region, as overlapsDomain() tells.
std::optional<unsigned> onlyQuarter(const Region& region) {
    constexpr std::array<std::array<unsigned, 2>, 2> kQuarters{{{0, 3}, {1, 2}}};
    const auto [lower, upper] = parameterBox(region);
    std::array<unsigned, 2> half{};
    for (int axis = 0; axis < 2; ++axis) {
        const auto meets = [&](double from) {
            return 2.0 * (upper[axis] - from) > kRegionRounding &&
                   1.0 - 2.0 * (lower[axis] - from) > kRegionRounding;
        };
        const bool isHigh = meets(0.5);
        if (meets(0.0) == isHigh) {
            return std::nullopt;
        }
        half[static_cast<std::size_t>(axis)] = isHigh ? 1 : 0;
    }
    return kQuarters[half[0]][half[1]];
}

bool isFlat(const LinearModel& model) {
    const Vec3d& du = model.middle.du;
    const Vec3d& dv = model.middle.dv;
    return glm::length(dv) * model.deviationU + glm::length(du) * model.deviationV <=
           kFlat * glm::length(glm::cross(du, dv));
}

double squaredDistance(const Box& box, const Vec3d& p) {
    const Vec3d outside = glm::max(glm::max(box.lower - p, p - box.upper), Vec3d(0.0));
    return glm::dot(outside, outside);
}

}  // namespace

PieceTree::PieceTree(const std::vector<LimitPiece>& pieces, std::uint32_t patchCount, PatchDomain domain)
    : domain_(domain) {
    nodes_.resize(patchCount);
    pieces_.reserve(pieces.size());
    for (const LimitPiece& piece : pieces) {
        insert(piece, static_cast<std::uint32_t>(pieces_.size()));
        pieces_.push_back(piece.bezier);
    }
    for (std::uint32_t i = 0; i < patchCount; ++i) {
        Facet whole;
        whole.patch = i;
        refine(i, whole, 0);
    }
    nodes_.shrink_to_fit();
    std::vector<std::uint32_t> order(patchCount);
    for (std::uint32_t i = 0; i < patchCount; ++i) {
        order[i] = i;
    }
    root_ = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    join(order, 0, order.size(), root_);
}

std::uint32_t PieceTree::addChildren(std::uint32_t node) {
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 4);
    nodes_[node].firstChild = first;
    return first;
}

void PieceTree::insert(const LimitPiece& piece, std::uint32_t index) {
    std::uint32_t node = piece.patch;
    ParameterMap map;
    Vec2d middle = piece.map.at(middleOf(domain_));
    for (unsigned level = 0; level < piece.depth; ++level) {
        const unsigned quarter = quarterAt(domain_, middle);
        const ParameterMap part = quarterMap(domain_, quarter);
        middle = intoQuarter(part, middle);
        map = map.then(part);
        const std::uint32_t first =
            nodes_[node].firstChild == kNone ? addChildren(node) : nodes_[node].firstChild;
        node = first + quarter;
    }
    FLUXWALK_CHECK(map.origin == piece.map.origin && map.du == piece.map.du && map.dv == piece.map.dv);
    FLUXWALK_CHECK_EQ(nodes_[node].piece, kNone);
    nodes_[node].piece = index;
}

// `levels` counts the quarterings below the patch.
void PieceTree::refine(std::uint32_t node, const Facet& part, unsigned levels) {
    if (nodes_[node].piece != kNone) {
        Facet facet = part;
        facet.piece = nodes_[node].piece;
        const BezierPiece net = restrictPiece(pieces_[facet.piece], facet.inPiece);
        facet.model = linearize(net);
        if (isFlat(facet.model) || levels >= kMaxFacetLevels) {
            Node& leaf = nodes_[node];
            leaf.box = boundPiece(net);
            leaf.normals = boundNormals(net);
            leaf.area = integrateArea(net, wholePatch(domain_));
            leaf.facet = static_cast<std::uint32_t>(facets_.size());
            facets_.push_back(facet);
            return;
        }
        const std::uint32_t first = addChildren(node);
        for (std::uint32_t k = 0; k < 4; ++k) {
            nodes_[first + k].piece = facet.piece;
        }
    }
    const bool inPiece = nodes_[node].piece != kNone;
    const std::uint32_t first = nodes_[node].firstChild;
    FLUXWALK_CHECK(first != kNone);
    for (unsigned k = 0; k < 4; ++k) {
        const ParameterMap quarter = quarterMap(domain_, k);
        Facet child = part;
        child.inPatch = part.inPatch.then(quarter);
        if (inPiece) {
            child.inPiece = part.inPiece.then(quarter);
        }
        refine(first + k, child, levels + 1);
    }
    summarize(node);
}

void PieceTree::summarize(std::uint32_t node) {
    Node& parent = nodes_[node];
    Vec3d sum(0.0);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const Node& child = nodes_[parent.firstChild + k];
        parent.box.extend(child.box);
        parent.area += child.area;
        sum += child.area * child.normals.axis;
    }
    const double length = glm::length(sum);
    parent.normals = {length > 1e-6 * parent.area ? sum / length : Vec3d(0, 0, 1), 0.0};
    for (std::uint32_t k = 0; k < 4; ++k) {
        const Node& child = nodes_[parent.firstChild + k];
        if (!child.box.isEmpty()) {
            const double reach =
                NormalCone::angleBetween(parent.normals.axis, child.normals.axis) + child.normals.halfAngle;
            parent.normals.halfAngle = std::min(base::kPi, std::max(parent.normals.halfAngle, reach));
        }
    }
}

// Makes `place` the tree over a range of patches: in the middle of the longer axes, twice, into four parts.
void PieceTree::join(std::vector<std::uint32_t>& patches, std::size_t begin, std::size_t end,
                     std::uint32_t place) {
    if (end - begin == 1) {
        nodes_[place] = nodes_[patches[begin]];
        return;
    }
    const auto split = [&](std::size_t from, std::size_t to) {
        Box centers;
        for (std::size_t i = from; i < to; ++i) {
            centers.extend(nodes_[patches[i]].box.center());
        }
        const Vec3d size = centers.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = from + (to - from + 1) / 2;
        std::nth_element(patches.begin() + static_cast<std::ptrdiff_t>(from),
                         patches.begin() + static_cast<std::ptrdiff_t>(middle),
                         patches.begin() + static_cast<std::ptrdiff_t>(to),
                         [&](std::uint32_t a, std::uint32_t b) {
                             const double ca = nodes_[a].box.center()[axis];
                             const double cb = nodes_[b].box.center()[axis];
                             return ca != cb ? ca < cb : a < b;
                         });
        return middle;
    };
    const std::size_t half = split(begin, end);
    const std::array<std::size_t, 5> ends{begin, split(begin, half), half, split(half, end), end};
    const std::uint32_t first = addChildren(place);
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (ends[k] < ends[k + 1]) {
            join(patches, ends[k], ends[k + 1], first + k);
        }
    }
    summarize(place);
}

PieceTree::Place PieceTree::find(std::uint32_t patch, const Vec2d& uv) const {
    Place place{nodes_[patch].piece, uv, 1.0};
    const Node* node = &nodes_[patch];
    while (node->piece == kNone) {
        const unsigned quarter = quarterAt(domain_, place.uv);
        const ParameterMap part = quarterMap(domain_, quarter);
        place.uv = intoQuarter(part, place.uv);
        place.scale /= part.du.x;
        node = &nodes_[node->firstChild + quarter];
    }
    place.piece = node->piece;
    return place;
}

Tangents PieceTree::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    const Place place = find(patch, uv);
    Tangents p = evaluatePiece(pieces_[place.piece], place.uv);
    p.du *= place.scale;
    p.dv *= place.scale;
    return p;
}

SurfacePoint PieceTree::pointAt(std::uint32_t patch, const Vec2d& uv) const {
    const Place place = find(patch, uv);
    SurfacePoint result;
    // Towards the middle of the piece, from no step at all to half the way.
    for (const double step : {0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5}) {
        const Vec2d at = place.uv + step * (middleOf(domain_) - place.uv);
        const Tangents p = evaluatePiece(pieces_[place.piece], at);
        const Vec3d n = glm::cross(p.du, p.dv);
        const double length = glm::length(n);
        if (step == 0.0) {
            result.position = p.position;
            result.jacobian = length * place.scale * place.scale;
        }
        if (length > 1e-7 * std::max(glm::dot(p.du, p.du), glm::dot(p.dv, p.dv))) {
            result.normal = n / length;
            return result;
        }
    }
    result.normal = nodes_[patch].normals.axis;
    return result;
}

bool PieceTree::normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const {
    // Down to where more than one part is met, or the only one is a leaf.
    const Node* node = &nodes_[patch];
    Region part = region;
    while (domain_ == PatchDomain::quad && node->firstChild != kNone) {
        const std::optional<unsigned> quarter = onlyQuarter(part);
        if (!quarter) {
            break;
        }
        const ParameterMap map = quarterMap(domain_, *quarter);
        for (Vec2d& corner : part.corners) {
            corner = 2.0 * (corner - map.origin);
        }
        node = &nodes_[node->firstChild + *quarter];
    }
    if (node->firstChild == kNone && !coversDomain(part, domain_)) {
        const ParameterMap within = partOfFacet(part);
        if (within.determinant() > 0.0) {
            const Facet& facet = facets_[node->facet];
            return surface::normalsLieWithin(restrictPiece(pieces_[facet.piece], facet.inPiece.then(within)),
                                             halfAngle);
        }
    }
    RegionBounds result;
    bool isEmpty = true;
    collectBounds(*node, part, result, isEmpty);
    return result.normals.halfAngle <= halfAngle;
}

ParameterMap PieceTree::partOfFacet(const Region& region) const {
    ParameterMap within;
    if (domain_ == PatchDomain::quad) {
        auto [lower, upper] = parameterBox(region);
        lower = glm::clamp(lower, Vec2d(0.0), Vec2d(1.0));
        upper = glm::clamp(upper, Vec2d(0.0), Vec2d(1.0));
        within = {lower, {upper.x - lower.x, 0.0}, {0.0, upper.y - lower.y}};
    } else if (liesInDomain(region, domain_) && region.cornerCount == 3) {
        within = {region.corners[0], region.corners[1] - region.corners[0],
                  region.corners[2] - region.corners[0]};
    }
    return within;
}

RegionBounds PieceTree::bounds(std::uint32_t patch, const Region& region) const {
    RegionBounds result;
    bool isEmpty = true;
    collectBounds(nodes_[patch], region, result, isEmpty);
    return result;
}

void PieceTree::collectBounds(const Node& node, const Region& region, RegionBounds& result,
                              bool& isEmpty) const {
    RegionBounds part{node.box, node.normals};
    if (!coversDomain(region, domain_)) {
        if (node.firstChild != kNone) {
            for (unsigned k = 0; k < 4; ++k) {
                const Region inChild = mapInto(quarterMap(domain_, k), region);
                if (overlapsDomain(inChild, domain_)) {
                    collectBounds(nodes_[node.firstChild + k], inChild, result, isEmpty);
                }
            }
            return;
        }
        const ParameterMap within = partOfFacet(region);
        if (within.determinant() > 0.0) {
            const Facet& facet = facets_[node.facet];
            const BezierPiece net = restrictPiece(pieces_[facet.piece], facet.inPiece.then(within));
            part = {boundPiece(net), boundNormals(net)};
        }
    }
    result.normals = isEmpty ? part.normals : NormalCone::merge(result.normals, part.normals);
    result.box.extend(part.box);
    isEmpty = false;
}

double PieceTree::area(std::uint32_t patch, const Region& region) const {
    return collectArea(nodes_[patch], region);
}

double PieceTree::collectArea(const Node& node, const Region& region) const {
    if (coversDomain(region, domain_)) {
        return node.area;
    }
    double sum = 0.0;
    if (node.firstChild != kNone) {
        for (unsigned k = 0; k < 4; ++k) {
            const Region inChild = mapInto(quarterMap(domain_, k), region);
            if (overlapsDomain(inChild, domain_)) {
                sum += collectArea(nodes_[node.firstChild + k], inChild);
            }
        }
        return sum;
    }
    const Facet& facet = facets_[node.facet];
    const auto integrate = [&](Region part) {
        for (Vec2d& corner : part.corners) {
            corner = facet.inPiece.at(corner);
        }
        return integrateArea(pieces_[facet.piece], part);
    };
    if (liesInDomain(region, domain_)) {
        return integrate(region);
    }
    const ClippedRegion polygon = clipToDomain(region, domain_);
    for (std::size_t i = 2; i < polygon.count; ++i) {
        sum += integrate({{polygon.corners[0], polygon.corners[i - 1], polygon.corners[i]}, 3});
    }
    return sum;
}

Vec2d PieceTree::locate(std::uint32_t patch, const Vec3d& position) const {
    // Depth first, nearest box first; boxes farther away than the best point are left out.
    struct Entry {
        const Node* node;
        double squared;
    };
    std::array<Entry, 64> stack;
    std::size_t size = 0;
    stack[size++] = {&nodes_[patch], 0.0};
    double best = std::numeric_limits<double>::infinity();
    Vec2d result(0.0);
    while (size > 0) {
        const Entry entry = stack[--size];
        if (entry.squared >= best) {
            continue;
        }
        if (entry.node->firstChild != kNone) {
            std::array<Entry, 4> children{};
            for (std::uint32_t k = 0; k < 4; ++k) {
                const Node& child = nodes_[entry.node->firstChild + k];
                children[k] = {&child, squaredDistance(child.box, position)};
            }
            std::sort(children.begin(), children.end(),
                      [](const Entry& a, const Entry& b) { return a.squared > b.squared; });
            for (const Entry& child : children) {
                stack[size++] = child;
            }
            continue;
        }
        // Gauss-Newton within the facet.
        const Facet& facet = facets_[entry.node->facet];
        Vec2d st = middleOf(domain_);
        for (int i = 0; i < 12; ++i) {
            const Tangents p = evaluatePiece(pieces_[facet.piece], facet.inPiece.at(st));
            const Vec3d du = facet.inPiece.du.x * p.du;
            const Vec3d dv = facet.inPiece.dv.y * p.dv;
            const Vec3d away = position - p.position;
            const double squared = glm::dot(away, away);
            if (squared < best) {
                best = squared;
                result = facet.inPatch.at(st);
            }
            const double a = glm::dot(du, du);
            const double b = glm::dot(du, dv);
            const double c = glm::dot(dv, dv);
            const double det = a * c - b * b;
            if (!(det > 1e-14 * a * c)) {
                break;
            }
            const double x = glm::dot(du, away);
            const double y = glm::dot(dv, away);
            const Vec2d next = clampToDomain(domain_, st + Vec2d(c * x - b * y, a * y - b * x) / det, 0.0);
            if (glm::distance(next, st) < 1e-15) {
                break;
            }
            st = next;
        }
    }
    return result;
}

bool PieceTree::bendsAway(std::uint32_t patch, double sign) const {
    const Node& node = nodes_[patch];
    return node.piece != kNone && node.normals.halfAngle < 0.5 * base::kPi &&
           surface::bendsAway(pieces_[node.piece], node.normals, sign, 1e-12 * node.box.diagonal());
}

}  // namespace fluxwalk::surface
