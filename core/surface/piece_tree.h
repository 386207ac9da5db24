#pragma once

#include <vector>

#include "core/surface/limit_pieces.h"

namespace fluxwalk::surface {

/// The pieces of a limit surface in one tree: below its root the patches, each quartered down to its pieces,
/// and those to facets, which are close to flat. It answers everything that a surface is asked for; nothing
/// allocates.
class PieceTree {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    /// What is known of a node's part of the surface.
    struct Node {
        Box box;
        NormalCone normals;
        double area = 0.0;
        /// Four children in a block, in the order of quarterMap() (above the patches: in any order, some
        /// perhaps empty); or none.
        std::uint32_t firstChild = kNone;
        /// The piece that the node is or is part of.
        std::uint32_t piece = kNone;
        /// Of leaves.
        std::uint32_t facet = kNone;
    };

    /// Part of a piece whose tangents hardly change.
    struct Facet {
        LinearModel model;
        ParameterMap inPiece;
        ParameterMap inPatch;
        std::uint32_t piece = kNone;
        std::uint32_t patch = kNone;
    };

    /// Pieces must tile the domains of `patchCount` patches.
    PieceTree(const std::vector<LimitPiece>& pieces, std::uint32_t patchCount, PatchDomain domain);

    PatchDomain domain() const { return domain_; }
    const Node& root() const { return nodes_[root_]; }
    const Node& node(std::uint32_t index) const { return nodes_[index]; }
    const Facet& facet(std::uint32_t index) const { return facets_[index]; }
    const BezierPiece& piece(std::uint32_t index) const { return pieces_[index]; }

    /// Position and derivatives by the patch's parameters.
    Tangents evaluate(std::uint32_t patch, const Vec2d& uv) const;
    /// Position, unit front normal and area measure. Where the derivatives are parallel, the normal is that
    /// of the nearest place where they are not.
    SurfacePoint pointAt(std::uint32_t patch, const Vec2d& uv) const;
    RegionBounds bounds(std::uint32_t patch, const Region& region) const;
    /// Whether the normals' cone in those bounds is no wider than `halfAngle` (radians), for less.
    bool normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const;
    double area(std::uint32_t patch, const Region& region) const;
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const;

    /// Whether a patch certainly bends away from its normals (sign 1) or towards them (sign -1) everywhere,
    /// so that no two of its points see each other on the front (back). (The line between two parameters then
    /// has an image that falls below the tangent plane at either end.) Certified for patches of one piece
    /// alone.
    bool bendsAway(std::uint32_t patch, double sign) const;

  private:
    /// A place in the tree during a descent, with a parameter in the coordinates of its piece.
    struct Place {
        std::uint32_t piece = kNone;
        Vec2d uv{};
        /// What a derivative in the piece is multiplied by to be one in the patch.
        double scale = 1.0;
    };
    Place find(std::uint32_t patch, const Vec2d& uv) const;
    std::uint32_t addChildren(std::uint32_t node);
    void insert(const LimitPiece& piece, std::uint32_t index);
    void refine(std::uint32_t node, const Facet& part, unsigned levels);
    void summarize(std::uint32_t node);
    void join(std::vector<std::uint32_t>& patches, std::size_t begin, std::size_t end, std::uint32_t place);
    void collectBounds(const Node& node, const Region& region, RegionBounds& result, bool& isEmpty) const;
    /// What of a leaf's domain bounds a region; all of it where that cannot be told.
    ParameterMap partOfFacet(const Region& region) const;
    double collectArea(const Node& node, const Region& region) const;

    PatchDomain domain_;
    std::uint32_t root_ = 0;
    /// The patches come first.
    std::vector<Node> nodes_;
    std::vector<Facet> facets_;
    std::vector<BezierPiece> pieces_;
};

}  // namespace fluxwalk::surface
