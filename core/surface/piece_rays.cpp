#include "core/surface/piece_rays.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::surface {

namespace {

/// How far facets reach over their borders, in their own coordinates.
constexpr double kOverlap = 1e-7;
/// Up to this deviation from the linear model, relative to what would make it singular, it has one root at
/// most and Newton's iteration finds it; parts that stray more are quartered.
constexpr double kContraction = 0.4;
/// Parts smaller than this part of the surface count as met where the ray meets their box.
constexpr double kPoint = 1e-10;
constexpr unsigned kMaxQuarterings = 40;

/// One ray and the first point met so far. Positions are taken to the plane across the ray: (x, y), zero on
/// it.
class Search {
  public:
    Search(const PieceTree& tree, const Vec3d& origin, const Vec3d& direction, double tNear, double tFar)
        : tree_(tree),
          origin_(origin),
          direction_(direction),
          inverseSquare_(1.0 / glm::dot(direction, direction)),
          tNear_(tNear),
          tFar_(tFar) {
        const Vec3d d = direction * std::sqrt(inverseSquare_);
        const Vec3d other = std::abs(d.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
        x_ = glm::normalize(glm::cross(d, other));
        y_ = glm::cross(d, x_);
        const Box& box = tree.root().box;
        size_ = box.diagonal();
        const Vec3d far = glm::max(glm::abs(box.lower - origin), glm::abs(box.upper - origin));
        pad_ = 1e-10 * size_ + 1e-14 * std::max({far.x, far.y, far.z});
        for (int i = 0; i < 3; ++i) {
            const double c = direction[i];
            inverse_[i] = std::abs(c) > 1e-150 ? 1.0 / c : std::copysign(1e150, c);
        }
    }

    std::optional<SurfaceHit> run() {
        struct Entry {
            std::uint32_t firstChild;
            std::uint32_t facet;
            double tEnter;
        };
        std::array<Entry, 128> stack;
        std::size_t size = 0;
        if (double t = 0.0; meetsBox(tree_.root().box, t)) {
            stack[size++] = {tree_.root().firstChild, tree_.root().facet, t};
        }
        while (size > 0) {
            const Entry entry = stack[--size];
            if (entry.tEnter >= tFar_) {
                continue;
            }
            if (entry.firstChild == PieceTree::kNone) {
                meetFacet(tree_.facet(entry.facet));
                continue;
            }
            // Farthest first onto the stack.
            const std::size_t base = size;
            for (std::uint32_t k = 0; k < 4; ++k) {
                const PieceTree::Node& child = tree_.node(entry.firstChild + k);
                if (double t = 0.0; meetsBox(child.box, t)) {
                    std::size_t at = size++;
                    for (; at > base && stack[at - 1].tEnter < t; --at) {
                        stack[at] = stack[at - 1];
                    }
                    stack[at] = {child.firstChild, child.facet, t};
                }
            }
        }
        return hit_;
    }

  private:
    // False for empty boxes too.
    bool meetsBox(const Box& box, double& tEnter) const {
        double near = tNear_;
        double far = tFar_;
        for (int i = 0; i < 3; ++i) {
            const double a = (box.lower[i] - pad_ - origin_[i]) * inverse_[i];
            const double b = (box.upper[i] + pad_ - origin_[i]) * inverse_[i];
            near = std::max(near, std::min(a, b));
            far = std::min(far, std::max(a, b));
        }
        tEnter = near;
        return near <= far * (1.0 + 1e-14) && box.lower.x <= box.upper.x;
    }

    Vec2d across(const Vec3d& v) const { return {glm::dot(x_, v), glm::dot(y_, v)}; }

    void meetFacet(const PieceTree::Facet& facet) {
        const Verdict verdict = tryNewton(facet, facet.model, facet.inPiece, facet.inPatch);
        if (verdict == Verdict::undecided) {
            const BezierPiece net = restrictPiece(tree_.piece(facet.piece), facet.inPiece);
            quarter(facet, net, facet.inPiece, facet.inPatch, 0);
        }
    }

    enum class Verdict : std::uint8_t { decided, undecided };

    bool isInside(const Vec2d& st, const Vec2d& margin) const {
        return st.x >= -margin.x && st.y >= -margin.y &&
               (tree_.domain() == PatchDomain::quad ? st.x <= 1.0 + margin.x && st.y <= 1.0 + margin.y
                                                    : st.x + st.y <= 1.0 + margin.x + margin.y);
    }

    // The part's only root, if its model allows to say so.
    Verdict tryNewton(const PieceTree::Facet& facet, const LinearModel& model, const ParameterMap& inPiece,
                      const ParameterMap& inPatch) {
        const Vec2d f = across(model.middle.position - origin_);
        const Vec2d fu = across(model.middle.du);
        const Vec2d fv = across(model.middle.dv);
        const double det = fu.x * fv.y - fu.y * fv.x;
        // In the norm max(|fu| |u|, |fv| |v|) what the inverse of the linear model makes of the surface
        // differs from the identity by this much at most.
        const double lengthU = glm::length(fu);
        const double lengthV = glm::length(fv);
        const double stray = lengthV * model.deviationU + lengthU * model.deviationV;
        if (!(stray <= kContraction * std::abs(det))) {
            return Verdict::undecided;
        }
        // So the root is no farther from the linear model's than that, times how far it may be from the
        // middle.
        const double reach = 0.67 * stray / std::abs(det) * std::max(lengthU, lengthV);
        Vec2d st = middleOf(tree_.domain()) - Vec2d(fv.y * f.x - fv.x * f.y, fu.x * f.y - fu.y * f.x) / det;
        if (!isInside(st, {reach / lengthU + kOverlap, reach / lengthV + kOverlap})) {
            return Verdict::decided;
        }
        // Outside of the part nothing is known of it.
        st = clampToDomain(tree_.domain(), st, kOverlap);
        const BezierPiece& piece = tree_.piece(facet.piece);
        for (int i = 0; i < 20; ++i) {
            const Tangents p = evaluatePiece(piece, inPiece.at(st));
            const Vec3d offset = p.position - origin_;
            const Vec2d g = across(offset);
            const Vec2d gu = across(inPiece.du.x * p.du);
            const Vec2d gv = across(inPiece.dv.y * p.dv);
            const double slope = gu.x * gv.y - gu.y * gv.x;
            if (slope == 0.0) {
                return Verdict::undecided;
            }
            const Vec2d step = Vec2d(gv.y * g.x - gv.x * g.y, gu.x * g.y - gu.y * g.x) / slope;
            const double length = std::abs(step.x) + std::abs(step.y);
            if (length < 1e-6) {
                // What is left is of the order of the square of the step.
                st -= step;
                if (isInside(st, Vec2d(kOverlap))) {
                    const Vec3d met = offset - step.x * inPiece.du.x * p.du - step.y * inPiece.dv.y * p.dv;
                    accept(glm::dot(met, direction_) * inverseSquare_, facet.patch, inPatch.at(st));
                }
                return Verdict::decided;
            }
            const Vec2d next = clampToDomain(tree_.domain(), st - step, kOverlap);
            if (glm::distance(next, st) < 1e-9) {
                // At the border, and the way to what is met leads out.
                return Verdict::decided;
            }
            st = next;
        }
        return Verdict::undecided;
    }

    void accept(double t, std::uint32_t patch, const Vec2d& uv) {
        if (t > tNear_ && t < tFar_) {
            tFar_ = t;
            Vec2d inside = glm::clamp(uv, Vec2d(0.0), Vec2d(1.0));
            if (tree_.domain() == PatchDomain::triangle && inside.x + inside.y > 1.0) {
                inside /= inside.x + inside.y;
            }
            hit_ = SurfaceHit{t, patch, inside};
        }
    }

    // Near silhouettes, where a part may be met twice: quarters until their models are good enough.
    void quarter(const PieceTree::Facet& facet, const BezierPiece& net, const ParameterMap& inPiece,
                 const ParameterMap& inPatch, unsigned level) {
        for (unsigned k = 0; k < 4; ++k) {
            const ParameterMap quarterOfNet = quarterMap(tree_.domain(), k);
            const BezierPiece part = restrictPiece(net, quarterOfNet);
            double extent = 0.0;
            if (!mayMeet(part, extent)) {
                continue;
            }
            const ParameterMap partInPiece = inPiece.then(quarterOfNet);
            const ParameterMap partInPatch = inPatch.then(quarterOfNet);
            const LinearModel model = linearize(part);
            if (extent < kPoint * size_ || level == kMaxQuarterings) {
                const Vec3d offset = model.middle.position - origin_;
                accept(glm::dot(offset, direction_) * inverseSquare_, facet.patch,
                       partInPatch.at(middleOf(tree_.domain())));
            } else if (tryNewton(facet, model, partInPiece, partInPatch) == Verdict::undecided) {
                quarter(facet, part, partInPiece, partInPatch, level + 1);
            }
        }
    }

    // Whether the box of a part, as seen along the ray, holds it, with some t in the range.
    bool mayMeet(const BezierPiece& part, double& extent) const {
        Vec3d lower(std::numeric_limits<double>::infinity());
        Vec3d upper(-lower);
        const std::size_t count = part.domain == PatchDomain::quad ? 16 : 15;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3d offset = part.points[i] - origin_;
            const Vec2d p = across(offset);
            const Vec3d q(p.x, p.y, glm::dot(offset, direction_) * inverseSquare_);
            lower = glm::min(lower, q);
            upper = glm::max(upper, q);
        }
        const double alongRay = (upper.z - lower.z) / std::sqrt(inverseSquare_);
        extent = std::max({upper.x - lower.x, upper.y - lower.y, alongRay});
        const double margin = kOverlap * extent + 0.01 * pad_;
        return lower.x <= margin && lower.y <= margin && upper.x >= -margin && upper.y >= -margin &&
               lower.z < tFar_ && upper.z > tNear_;
    }

    const PieceTree& tree_;
    Vec3d origin_;
    Vec3d direction_;
    double inverseSquare_;
    double tNear_;
    double tFar_;
    Vec3d x_{};
    Vec3d y_{};
    Vec3d inverse_{};
    double size_ = 0.0;
    double pad_ = 0.0;
    std::optional<SurfaceHit> hit_;
};

}  // namespace

std::optional<SurfaceHit> intersectPieces(const PieceTree& tree, const Vec3d& origin, const Vec3d& direction,
                                          double tNear, double tFar) {
    if (!(glm::dot(direction, direction) > 0.0)) {
        return std::nullopt;
    }
    return Search(tree, origin, direction, tNear, tFar).run();
}

}  // namespace fluxwalk::surface
