#pragma once

#include <memory>
#include <vector>

#include "core/surface/control_cage.h"
#include "core/surface/surface.h"

namespace fluxwalk::surface {

class PieceTree;

/// Limit surface of a control cage: one patch for each face, and n for a face of n != 4 corners in the
/// Catmull-Clark scheme (limit_pieces.h says which, and how close to the limit they are).
class SubdivisionSurface final : public Surface {
  public:
    /// The cage must be sound (findDefect).
    explicit SubdivisionSurface(const ControlCage& cage);
    ~SubdivisionSurface() override;

    std::string_view kind() const override { return "subdivision surface"; }
    std::uint32_t patchCount() const override { return static_cast<std::uint32_t>(patches_.size()); }
    PatchDomain domain(std::uint32_t patch) const override;
    /// Positions on an edge come from one of the patches that share it, normals from the patch that is asked.
    SurfacePoint evaluate(std::uint32_t patch, const Vec2d& uv) const override;
    Strips strips(std::uint32_t patch) const override { return patches_[patch].strips; }
    Vec2d locate(std::uint32_t patch, const Vec3d& position) const override;
    /// Bilinear (on triangles linear) between the corners of a patch; those of sub-faces are means over the
    /// face's.
    Vec2d texcoord(std::uint32_t patch, const Vec2d& uv, unsigned set) const override;
    bool isPlanar(std::uint32_t /*patch*/) const override { return false; }
    /// False only where the patch certainly curves one way.
    bool canSeeItself(std::uint32_t patch, bool back) const override;
    RegionBounds bounds(std::uint32_t patch, const Region& region) const override;
    bool normalsLieWithin(std::uint32_t patch, const Region& region, double halfAngle) const override;
    double area(std::uint32_t patch, const Region& region) const override;
    std::optional<SurfaceHit> intersect(const Vec3d& origin, const Vec3d& direction, double tNear,
                                        double tFar) const override;
    Box bounds() const override;

    const ControlCage& cage() const { return cage_; }

  private:
    /// Sides of patches that give an edge its points: one from end to end, or two, half of it each.
    struct Edge {
        std::uint32_t patch = 0;
        std::uint32_t side = 0;
        std::uint32_t secondPatch = 0;
        std::uint32_t secondSide = 0;
        bool isHalved = false;
    };
    /// The edge that a patch's side is or is half of: at t of the side lies the edge's offset + scale t.
    struct Side {
        std::uint32_t edge = 0;
        double offset = 0.0;
        double scale = 1.0;
    };
    struct Patch {
        std::array<Side, 4> sides{};
        std::array<Vec3d, 4> corners{};
        std::array<std::array<base::Vec2, 4>, 2> texcoords{};
        bool seesItselfInFront = true;
        bool seesItselfBehind = true;
        Strips strips;
    };
    class Builder;

    Vec3d pointOnEdge(const Edge& edge, double s) const;

    ControlCage cage_;
    std::vector<Edge> edges_;
    std::vector<Patch> patches_;
    std::unique_ptr<const PieceTree> tree_;
};

}  // namespace fluxwalk::surface
