#include "core/surface/subdivision_surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/check.h"
#include "core/surface/piece_rays.h"
#include "core/surface/piece_tree.h"
#include "core/surface/region.h"
#include "core/surface/strips.h"

namespace fluxwalk::surface {

namespace {

PatchDomain domainOf(const ControlCage& cage) {
    return cage.scheme == SubdivisionScheme::loop ? PatchDomain::triangle : PatchDomain::quad;
}

/// Point on side `side` of a domain, t of the way from its first corner.
Vec2d onSide(PatchDomain domain, std::uint32_t side, double t) {
    if (domain == PatchDomain::triangle) {
        return side == 0 ? Vec2d(t, 0.0) : side == 1 ? Vec2d(1.0 - t, t) : Vec2d(0.0, 1.0 - t);
    }
    return side == 0   ? Vec2d(t, 0.0)
           : side == 1 ? Vec2d(1.0, t)
           : side == 2 ? Vec2d(1.0 - t, 1.0)
                       : Vec2d(0.0, 1.0 - t);
}

/// A patch's side on which a parameter lies, and where on it.
struct SidePoint {
    std::uint32_t side = 0;
    double t = 0.0;
};

std::optional<SidePoint> sideOf(PatchDomain domain, const Vec2d& uv) {
    if (uv.y == 0.0) {
        return SidePoint{0, uv.x};
    }
    if (domain == PatchDomain::triangle) {
        // Sums of parameters that are no dyadic fractions miss 1 by their rounding.
        if (std::abs(1.0 - uv.x - uv.y) < 1e-15) {
            return SidePoint{1, uv.y};
        }
        return uv.x == 0.0 ? std::optional(SidePoint{2, 1.0 - uv.y}) : std::nullopt;
    }
    if (uv.x == 1.0) {
        return SidePoint{1, uv.y};
    }
    if (uv.y == 1.0) {
        return SidePoint{2, 1.0 - uv.x};
    }
    return uv.x == 0.0 ? std::optional(SidePoint{3, 1.0 - uv.y}) : std::nullopt;
}

}  // namespace

/// Lays out the patches of a cage's faces. The first face at an edge or vertex gives it its points.
class SubdivisionSurface::Builder {
  public:
    Builder(SubdivisionSurface& surface, const ControlCage& cage) : surface_(surface), cage_(cage) {}

    void layOut() {
        const bool isLoop = cage_.scheme == SubdivisionScheme::loop;
        std::size_t first = 0;
        for (const std::uint32_t count : cage_.faceSizes) {
            if (count == 4 || isLoop) {
                addFace(first, count);
            } else {
                addSubFaces(first, count);
            }
            first += count;
        }
    }

    /// Positions of the patches' corners, when the tree is there.
    void placeCorners() {
        std::vector<std::optional<Vec3d>> vertices(cage_.positions.size());
        std::size_t first = 0;
        std::uint32_t patch = 0;
        const PatchDomain domain = domainOf(cage_);
        for (const std::uint32_t count : cage_.faceSizes) {
            const bool isWhole = count == 4 || domain == PatchDomain::triangle;
            for (std::uint32_t k = 0; k < count; ++k) {
                const std::uint32_t here = isWhole ? patch : patch + k;
                Patch& p = surface_.patches_[here];
                std::optional<Vec3d>& vertex = vertices[cage_.corners[first + k]];
                if (!vertex) {
                    vertex = surface_.tree_->evaluate(here, onSide(domain, isWhole ? k : 0, 0.0)).position;
                }
                p.corners[isWhole ? k : 0] = *vertex;
                if (!isWhole) {
                    const auto middleOfEdge = [&](const Side& side) {
                        return surface_.pointOnEdge(surface_.edges_[side.edge], 0.5);
                    };
                    p.corners[1] = middleOfEdge(p.sides[0]);
                    p.corners[2] = surface_.tree_->evaluate(patch, Vec2d(1.0)).position;
                    p.corners[3] = middleOfEdge(p.sides[3]);
                }
            }
            first += count;
            patch += isWhole ? 1 : count;
        }
    }

  private:
    /// An edge of the cage, and the vertex that its parameter starts from.
    struct KnownEdge {
        std::uint32_t edge = 0;
        std::uint32_t from = 0;
    };

    std::uint32_t patchCount() const { return static_cast<std::uint32_t>(surface_.patches_.size()); }
    std::uint32_t cornerOf(std::size_t first, std::uint32_t count, std::uint32_t k) const {
        return cage_.corners[first + k % count];
    }

    // The edge between two vertices, made as `own` if it is new.
    KnownEdge edgeBetween(std::uint32_t from, std::uint32_t to, const Edge& own) {
        const std::uint64_t key = std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
        const auto next = static_cast<std::uint32_t>(surface_.edges_.size());
        const auto [found, isNew] = known_.try_emplace(key, KnownEdge{next, from});
        if (isNew) {
            surface_.edges_.push_back(own);
        }
        return found->second;
    }

    void addFace(std::size_t first, std::uint32_t count) {
        Patch patch;
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t from = cornerOf(first, count, k);
            const KnownEdge known =
                edgeBetween(from, cornerOf(first, count, k + 1), {patchCount(), k, 0, 0, false});
            patch.sides[k] = known.from == from ? Side{known.edge, 0.0, 1.0} : Side{known.edge, 1.0, -1.0};
            for (std::size_t set = 0; set < 2; ++set) {
                if (!cage_.texcoords[set].empty()) {
                    patch.texcoords[set][k] = cage_.texcoords[set][first + k];
                }
            }
        }
        surface_.patches_.push_back(patch);
    }

    // Sub-face k: vertex k, middle of its edge, middle of the face, middle of the edge before.
    void addSubFaces(std::size_t first, std::uint32_t count) {
        const std::uint32_t base = patchCount();
        // Spokes from the edges' middles to the face's: side 1 of one sub-face, side 2 of the next.
        const auto spokes = static_cast<std::uint32_t>(surface_.edges_.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            surface_.edges_.push_back({base + k, 1, 0, 0, false});
        }
        surface_.patches_.resize(base + count);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t next = (k + 1) % count;
            const std::uint32_t from = cornerOf(first, count, k);
            const KnownEdge known =
                edgeBetween(from, cornerOf(first, count, next), {base + k, 0, base + next, 3, true});
            Patch& patch = surface_.patches_[base + k];
            Patch& after = surface_.patches_[base + next];
            const bool forward = known.from == from;
            patch.sides[0] = forward ? Side{known.edge, 0.0, 0.5} : Side{known.edge, 1.0, -0.5};
            after.sides[3] = forward ? Side{known.edge, 0.5, 0.5} : Side{known.edge, 0.5, -0.5};
            patch.sides[1] = {spokes + k, 0.0, 1.0};
            after.sides[2] = {spokes + k, 1.0, -1.0};
        }
        for (std::size_t set = 0; set < 2; ++set) {
            if (!cage_.texcoords[set].empty()) {
                spreadTexcoords(cage_.texcoords[set].data() + first, count, set, base);
            }
        }
    }

    void spreadTexcoords(const base::Vec2* corner, std::uint32_t count, std::size_t set, std::uint32_t base) {
        base::Vec2 middle(0.0f);
        for (std::uint32_t k = 0; k < count; ++k) {
            middle += corner[k] / static_cast<float>(count);
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            const base::Vec2& here = corner[k];
            surface_.patches_[base + k].texcoords[set] = {here, 0.5f * (here + corner[(k + 1) % count]),
                                                          middle,
                                                          0.5f * (here + corner[(k + count - 1) % count])};
        }
    }

    SubdivisionSurface& surface_;
    const ControlCage& cage_;
    std::unordered_map<std::uint64_t, KnownEdge> known_;
};

SubdivisionSurface::SubdivisionSurface(const ControlCage& cage) : cage_(cage) {
    const auto defect = findDefect(cage);
    FLUXWALK_CHECK_EQ(defect.value_or(""), "");
    Builder builder(*this, cage);
    builder.layOut();
    tree_ = std::make_unique<PieceTree>(findLimitPieces(cage), patchCount(), domainOf(cage));
    builder.placeCorners();
    for (std::uint32_t i = 0; i < patchCount(); ++i) {
        patches_[i].seesItselfInFront = !tree_->bendsAway(i, 1.0);
        patches_[i].seesItselfBehind = !tree_->bendsAway(i, -1.0);
        if (tree_->domain() == PatchDomain::quad) {
            patches_[i].strips =
                measureStrips([&](const Vec2d& uv) { return tree_->evaluate(i, uv).position; });
        }
    }
}

SubdivisionSurface::~SubdivisionSurface() = default;

PatchDomain SubdivisionSurface::domain(std::uint32_t /*patch*/) const {
    return tree_->domain();
}

// An edge's parameter 0.5 belongs to the second half.
Vec3d SubdivisionSurface::pointOnEdge(const Edge& edge, double s) const {
    const PatchDomain domain = tree_->domain();
    if (!edge.isHalved) {
        return tree_->evaluate(edge.patch, onSide(domain, edge.side, s)).position;
    }
    if (s < 0.5) {
        return tree_->evaluate(edge.patch, onSide(domain, edge.side, 2.0 * s)).position;
    }
    return tree_->evaluate(edge.secondPatch, onSide(domain, edge.secondSide, 2.0 * s - 1.0)).position;
}

SurfacePoint SubdivisionSurface::evaluate(std::uint32_t patch, const Vec2d& uv) const {
    SurfacePoint result = tree_->pointAt(patch, uv);
    if (const auto at = sideOf(tree_->domain(), uv)) {
        const Patch& own = patches_[patch];
        const std::uint32_t sides = tree_->domain() == PatchDomain::quad ? 4 : 3;
        const Side& side = own.sides[at->side];
        result.position = at->t == 0.0   ? own.corners[at->side]
                          : at->t == 1.0 ? own.corners[(at->side + 1) % sides]
                                         : pointOnEdge(edges_[side.edge], side.offset + side.scale * at->t);
    }
    return result;
}

Vec2d SubdivisionSurface::locate(std::uint32_t patch, const Vec3d& position) const {
    return tree_->locate(patch, position);
}

Vec2d SubdivisionSurface::texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const {
    const std::array<base::Vec2, 4>& c = patches_[patch].texcoords[set];
    if (tree_->domain() == PatchDomain::triangle) {
        return (1.0 - uv.x - uv.y) * Vec2d(c[0]) + uv.x * Vec2d(c[1]) + uv.y * Vec2d(c[2]);
    }
    return (1.0 - uv.y) * ((1.0 - uv.x) * Vec2d(c[0]) + uv.x * Vec2d(c[1])) +
           uv.y * ((1.0 - uv.x) * Vec2d(c[3]) + uv.x * Vec2d(c[2]));
}

bool SubdivisionSurface::canSeeItself(std::uint32_t patch, bool back) const {
    return back ? patches_[patch].seesItselfBehind : patches_[patch].seesItselfInFront;
}

RegionBounds SubdivisionSurface::bounds(std::uint32_t patch, const Region& region) const {
    return tree_->bounds(patch, region);
}

bool SubdivisionSurface::normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const {
    return tree_->normalsLieWithin(patch, region, halfAngle);
}

double SubdivisionSurface::area(std::uint32_t patch, const Region& region) const {
    return tree_->area(patch, region);
}

std::optional<SurfaceHit> SubdivisionSurface::intersect(const Vec3d& origin, const Vec3d& direction,
                                                        double tNear, double tFar) const {
    return intersectPieces(*tree_, origin, direction, tNear, tFar);
}

Box SubdivisionSurface::bounds() const {
    return tree_->root().box;
}

}  // namespace fluxwalk::surface
