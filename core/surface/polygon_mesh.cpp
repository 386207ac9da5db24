#include "core/surface/polygon_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "core/base/random.h"
#include "core/surface/strips.h"

namespace fluxwalk::surface {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Quad = std::array<std::uint32_t, 4>;

/// A fourth corner may lie this far off the plane of the other three, relative to the longest edge: the
/// rounding of float input.
constexpr double kCoplanar = 2e-6;
/// Least sine of a quad's corner angle.
constexpr double kMinCornerSine = 0.05;

Vec3d normalOf(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return glm::cross(b - a, c - a);
}

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t key = 0;
        for (int i = 0; i < 3; ++i) {
            key = base::combine(key, std::bit_cast<std::uint32_t>(p[i] == 0.0f ? 0.0f : p[i]));
        }
        return static_cast<std::size_t>(key);
    }
};

/// Decides which pairs of triangles merge into quads.
class Pairing {
  public:
    Pairing(const std::vector<Vec3>& positions, const std::array<std::vector<base::Vec2>, 2>& texcoords,
            const std::vector<Triangle>& triangles)
        : positions_(positions), texcoords_(texcoords), triangles_(triangles) {}

    /// For each triangle the quad that it opens (as first triangle) or nothing; `partner` gets the second
    /// triangle.
    std::vector<std::uint32_t> run(std::vector<Quad>& quadOf) {
        constexpr std::uint32_t kNone = 0xffffffffu;
        weld();
        std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> byEdge;
        byEdge.reserve(triangles_.size() * 2);
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            for (unsigned e = 0; e < 3; ++e) {
                byEdge[edgeKey(welded_[triangles_[t][e]], welded_[triangles_[t][(e + 1) % 3]])].push_back(t);
            }
        }
        std::vector<std::uint32_t> partner(triangles_.size(), kNone);
        quadOf.assign(triangles_.size(), Quad{});
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (partner[t] != kNone) {
                continue;
            }
            double best = kMinCornerSine;
            std::uint32_t bestOther = kNone;
            Quad bestQuad{};
            for (unsigned e = 0; e < 3; ++e) {
                const auto& sharing =
                    byEdge[edgeKey(welded_[triangles_[t][e]], welded_[triangles_[t][(e + 1) % 3]])];
                if (sharing.size() != 2) {
                    continue;
                }
                const std::uint32_t other = sharing[0] == t ? sharing[1] : sharing[0];
                Quad quad{};
                if (other == t || partner[other] != kNone || !join(t, e, other, quad)) {
                    continue;
                }
                const double quality = cornerQuality(quad);
                if (quality > best) {
                    best = quality;
                    bestOther = other;
                    bestQuad = quad;
                }
            }
            if (bestOther != kNone) {
                partner[t] = bestOther;
                partner[bestOther] = t;
                quadOf[t] = bestQuad;
            }
        }
        return partner;
    }

  private:
    static std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
        return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    }

    void weld() {
        std::unordered_map<Vec3, std::uint32_t, PositionHash> first;
        first.reserve(positions_.size());
        welded_.resize(positions_.size());
        for (std::uint32_t i = 0; i < positions_.size(); ++i) {
            welded_[i] = first.try_emplace(positions_[i], i).first->second;
        }
    }

    Vec3d at(std::uint32_t i) const { return Vec3d(positions_[i]); }

    // Quad from triangle t, whose edge e is shared, and the corner of `other` that is not on that edge.
    bool join(std::uint32_t t, unsigned e, std::uint32_t other, Quad& quad) const {
        const std::uint32_t a = triangles_[t][e];
        const std::uint32_t b = triangles_[t][(e + 1) % 3];
        const std::uint32_t c = triangles_[t][(e + 2) % 3];
        for (unsigned f = 0; f < 3; ++f) {
            // The neighbour runs along the edge the other way where both face the same side.
            const std::uint32_t oa = triangles_[other][(f + 1) % 3];
            const std::uint32_t ob = triangles_[other][f];
            if (welded_[oa] != welded_[a] || welded_[ob] != welded_[b]) {
                continue;
            }
            const std::uint32_t d = triangles_[other][(f + 2) % 3];
            quad = {c, a, d, b};
            return isCoplanar(at(a), at(b), at(c), at(d)) && sameTexcoords(a, oa) && sameTexcoords(b, ob) &&
                   affineTexcoords(quad);
        }
        return false;
    }

    bool sameTexcoords(std::uint32_t i, std::uint32_t j) const {
        return std::all_of(texcoords_.begin(), texcoords_.end(),
                           [&](const auto& set) { return set.empty() || set[i] == set[j]; });
    }

    // Whether the fourth corner's coordinate is what the first triangle's affine map gives there.
    bool affineTexcoords(const Quad& q) const {
        const Vec3d p0 = at(q[0]);
        const Vec3d e1 = at(q[1]) - p0;
        const Vec3d e3 = at(q[3]) - p0;
        const Vec3d d = at(q[2]) - p0;
        const double a = glm::dot(e1, e1);
        const double b = glm::dot(e1, e3);
        const double c = glm::dot(e3, e3);
        const double det = a * c - b * b;
        const double s = (c * glm::dot(d, e1) - b * glm::dot(d, e3)) / det;
        const double t = (a * glm::dot(d, e3) - b * glm::dot(d, e1)) / det;
        for (const auto& set : texcoords_) {
            if (set.empty()) {
                continue;
            }
            const Vec2d t0(set[q[0]]);
            const Vec2d u1 = Vec2d(set[q[1]]) - t0;
            const Vec2d u3 = Vec2d(set[q[3]]) - t0;
            const Vec2d miss = t0 + s * u1 + t * u3 - Vec2d(set[q[2]]);
            if (glm::length(miss) > 1e-4 * (glm::length(u1) + glm::length(u3)) + 1e-7) {
                return false;
            }
        }
        return true;
    }

    // Least sine over the four corners, negative where the quad is not convex.
    double cornerQuality(const Quad& q) const {
        const Vec3d n = glm::normalize(normalOf(at(q[0]), at(q[1]), at(q[3])));
        double least = 1.0;
        for (unsigned i = 0; i < 4; ++i) {
            const Vec3d in = at(q[i]) - at(q[(i + 3) % 4]);
            const Vec3d out = at(q[(i + 1) % 4]) - at(q[i]);
            const double lengths = glm::length(in) * glm::length(out);
            least = std::min(least, lengths > 0.0 ? glm::dot(n, glm::cross(in, out)) / lengths : -1.0);
        }
        return least;
    }

    const std::vector<Vec3>& positions_;
    const std::array<std::vector<base::Vec2>, 2>& texcoords_;
    const std::vector<Triangle>& triangles_;
    std::vector<std::uint32_t> welded_;
};

bool hasArea(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double doubled = glm::length(normalOf(a, b, c));
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    return std::isfinite(doubled) && doubled > 1e-7 * longest * longest && longest > 0.0;
}

}  // namespace

bool isCoplanar(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const Vec3d n = normalOf(a, b, c);
    const double longest = std::max({glm::distance(a, b), glm::distance(a, c), glm::distance(a, d)});
    return std::abs(glm::dot(glm::normalize(n), d - a)) <= kCoplanar * longest;
}

PolygonMesh::PolygonMesh(TriangleSoup soup)
    : positions_(std::move(soup.positions)), texcoords_(std::move(soup.texcoords)) {
    triangles_.reserve(soup.triangles.size());
    for (const Triangle& t : soup.triangles) {
        if (hasArea(Vec3d(positions_[t[0]]), Vec3d(positions_[t[1]]), Vec3d(positions_[t[2]]))) {
            triangles_.push_back(t);
            for (const std::uint32_t i : t) {
                box_.extend(Vec3d(positions_[i]));
            }
        } else {
            ++dropped_;
        }
    }
    std::vector<Quad> quadOf;
    const std::vector<std::uint32_t> partner = Pairing(positions_, texcoords_, triangles_).run(quadOf);
    patchOfTriangle_.assign(triangles_.size(), 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        const bool paired = partner[t] != 0xffffffffu;
        const bool opens = quadOf[t] != Quad{};
        if (paired && !opens) {
            continue;
        }
        const auto patch = static_cast<std::uint32_t>(patches_.size());
        patchOfTriangle_[t] = patch;
        if (paired) {
            patchOfTriangle_[partner[t]] = patch;
            patches_.push_back(quadOf[t]);
        } else {
            const Triangle& c = triangles_[t];
            patches_.push_back({c[0], c[1], c[2], c[2]});
        }
    }
}

std::uint32_t PolygonMesh::cornerCount(std::uint32_t patch) const {
    return patches_[patch][2] == patches_[patch][3] ? 3u : 4u;
}

std::array<Vec3d, 4> PolygonMesh::corners(std::uint32_t patch) const {
    const Quad& q = patches_[patch];
    return {Vec3d(positions_[q[0]]), Vec3d(positions_[q[1]]), Vec3d(positions_[q[2]]),
            Vec3d(positions_[q[3]])};
}

PatchDomain PolygonMesh::domain(std::uint32_t patch) const {
    return cornerCount(patch) == 3 ? PatchDomain::triangle : PatchDomain::quad;
}

Strips PolygonMesh::strips(std::uint32_t patch) const {
    if (cornerCount(patch) == 3) {
        return {};
    }
    const auto c = corners(patch);
    return chooseStrips(glm::distance(c[0], c[1]) + glm::distance(c[3], c[2]),
                        glm::distance(c[0], c[3]) + glm::distance(c[1], c[2]));
}

// Written so that on an edge exactly its two ends enter, with weights that neighbours share bitwise.
Vec3d PolygonMesh::position(std::uint32_t patch, const Vec2d& uv) const {
    const auto c = corners(patch);
    if (cornerCount(patch) == 3) {
        return (1.0 - uv.x - uv.y) * c[0] + uv.x * c[1] + uv.y * c[2];
    }
    const Vec3d low = (1.0 - uv.x) * c[0] + uv.x * c[1];
    const Vec3d high = (1.0 - uv.x) * c[3] + uv.x * c[2];
    return (1.0 - uv.y) * low + uv.y * high;
}

SurfacePoint PolygonMesh::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    const auto c = corners(patch);
    Vec3d du = c[1] - c[0];
    Vec3d dv = c[2] - c[0];
    Vec3d flat = glm::cross(du, dv);
    if (cornerCount(patch) == 4) {
        flat = glm::cross(c[2] - c[0], c[3] - c[1]);
        du = (1.0 - uv.y) * (c[1] - c[0]) + uv.y * (c[2] - c[3]);
        dv = (1.0 - uv.x) * (c[3] - c[0]) + uv.x * (c[2] - c[1]);
    }
    return {position(patch, uv), glm::normalize(flat), glm::length(glm::cross(du, dv))};
}

Vec2d PolygonMesh::locate(std::uint32_t patch, const Vec3d& p) const {
    const auto c = corners(patch);
    const bool isTriangle = cornerCount(patch) == 3;
    // Newton's iteration on the (bi)linear map, from the middle; exact after one step for triangles and
    // parallelograms.
    Vec2d uv = isTriangle ? Vec2d(1.0 / 3.0) : Vec2d(0.5);
    for (int step = 0; step < 12; ++step) {
        const Vec3d miss = p - position(patch, uv);
        const Vec3d du = isTriangle ? c[1] - c[0] : (1.0 - uv.y) * (c[1] - c[0]) + uv.y * (c[2] - c[3]);
        const Vec3d dv = isTriangle ? c[2] - c[0] : (1.0 - uv.x) * (c[3] - c[0]) + uv.x * (c[2] - c[1]);
        const double a = glm::dot(du, du);
        const double b = glm::dot(du, dv);
        const double d = glm::dot(dv, dv);
        const double det = a * d - b * b;
        if (!(det > 0.0)) {
            break;
        }
        const double x = glm::dot(miss, du);
        const double y = glm::dot(miss, dv);
        const Vec2d move((d * x - b * y) / det, (a * y - b * x) / det);
        uv += move;
        if (std::abs(move.x) + std::abs(move.y) < 1e-13) {
            break;
        }
    }
    uv = glm::clamp(uv, Vec2d(0.0), Vec2d(1.0));
    if (isTriangle && uv.x + uv.y > 1.0) {
        const double excess = 0.5 * (uv.x + uv.y - 1.0);
        uv = glm::clamp(uv - Vec2d(excess), Vec2d(0.0), Vec2d(1.0));
    }
    return uv;
}

Vec2d PolygonMesh::texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const {
    const auto& coordinates = texcoords_[set];
    if (coordinates.empty()) {
        return Vec2d(0.0);
    }
    const Quad& q = patches_[patch];
    const Vec2d c0(coordinates[q[0]]);
    const Vec2d c1(coordinates[q[1]]);
    const Vec2d c2(coordinates[q[2]]);
    if (cornerCount(patch) == 3) {
        return (1.0 - uv.x - uv.y) * c0 + uv.x * c1 + uv.y * c2;
    }
    const Vec2d c3(coordinates[q[3]]);
    return (1.0 - uv.y) * ((1.0 - uv.x) * c0 + uv.x * c1) + uv.y * ((1.0 - uv.x) * c3 + uv.x * c2);
}

bool PolygonMesh::isPlanar(std::uint32_t /*patch*/) const {
    return true;
}

bool PolygonMesh::canSeeItself(std::uint32_t /*patch*/, bool /*back*/) const {
    return false;
}

RegionBounds PolygonMesh::bounds(std::uint32_t patch, const Region& region) const {
    RegionBounds result;
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        result.box.extend(position(patch, region.corners[i]));
    }
    result.normals = {evaluate(patch, region.corners[0]).normal, 0.0};
    return result;
}

double PolygonMesh::area(std::uint32_t patch, const Region& region) const {
    const Vec3d a = position(patch, region.corners[0]);
    const Vec3d b = position(patch, region.corners[1]);
    const Vec3d c = position(patch, region.corners[2]);
    if (region.cornerCount == 3) {
        return 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return 0.5 * glm::length(glm::cross(c - a, position(patch, region.corners[3]) - b));
}

std::optional<SurfaceHit> PolygonMesh::intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                                 double tFar) const {
    // Brute force over the triangles (Moeller-Trumbore): a reference for tests; rays go through their own
    // acceleration structure.
    std::optional<SurfaceHit> best;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Vec3d a(positions_[triangles_[i][0]]);
        const Vec3d e1 = Vec3d(positions_[triangles_[i][1]]) - a;
        const Vec3d e2 = Vec3d(positions_[triangles_[i][2]]) - a;
        const Vec3d p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        if (det == 0.0) {
            continue;
        }
        const Vec3d s = origin - a;
        const double u = glm::dot(s, p) / det;
        const Vec3d q = glm::cross(s, e1);
        const double v = glm::dot(direction, q) / det;
        const double t = glm::dot(e2, q) / det;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > tNear && t < tFar && (!best || t < best->t)) {
            const std::uint32_t patch = patchOfTriangle_[i];
            best = SurfaceHit{t, patch, locate(patch, origin + t * direction)};
        }
    }
    return best;
}

TriangleView PolygonMesh::triangles() const {
    return {positions_, triangles_, patchOfTriangle_};
}

}  // namespace fluxwalk::surface
