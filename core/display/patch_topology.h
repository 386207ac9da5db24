#pragma once

#include <array>
#include <vector>

#include "core/display/point_table.h"
#include "core/surface/surface.h"

namespace fluxwalk::display {

using base::Rgb;
using base::Vec2d;
using base::Vec3;
using base::Vec3d;

/// Grid coordinates in a patch: corners of elements are whole multiples of 2^-31 of the patch's sides (in the
/// order of splits, whatever `splitPoint` makes of it in u,v).
struct GridPoint {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};
inline constexpr std::uint32_t kGridSize = 1u << 31;

constexpr GridPoint middleOf(const GridPoint& a, const GridPoint& b) {
    // The sum of two coordinates may need 33 bits.
    return {a.x / 2 + b.x / 2 + ((a.x & b.x) & 1u), a.y / 2 + b.y / 2 + ((a.y & b.y) & 1u)};
}

/// Which patches of a surface meet along which edges and corners. It does not change while a solution is
/// refined: make one for each object and keep it, together with the surface.
///
/// Corners are one where their positions are bitwise equal; edges are one where their ends and middles are.
/// Where a corner of one patch lies in the middle of another's straight, otherwise free edge (within 2e-6 of
/// the surface's largest coordinate), and so on in the halves, both halves of that edge are edges on their
/// own, so that meshes close there too. Likewise where it is the middle of a curved one, bitwise.
class PatchTopology {
  public:
    explicit PatchTopology(const surface::Surface& surface);

    const surface::Surface& surface() const { return surface_; }
    std::uint32_t cornerCount(std::uint32_t patch) const { return patches_[patch].cornerCount; }
    surface::Strips strips(std::uint32_t patch) const { return surface_.strips(patch); }
    /// Whether no other patch meets this one in any part of a side, between corners `side` and `side` + 1.
    bool isFree(std::uint32_t patch, std::uint32_t side) const {
        const Edge& edge = edges_[patches_[patch].sides[side].edge];
        return edge.patchCount == 1 && edge.middleCorner == kNone;
    }
    /// Whether some texture coordinate of this set is not zero at a corner.
    bool hasTexcoords(unsigned set) const { return hasTexcoords_[set]; }

    /// Name of a grid point, the same from all patches that share it.
    PointKey keyOf(std::uint32_t patch, const GridPoint& p) const {
        const Patch& q = patches_[patch];
        if (p.y == 0) {
            return keyOnSide(q, 0, p.x);
        }
        if (p.x == 0) {
            return keyOnSide(q, q.cornerCount - 1, kGridSize - p.y);
        }
        if (q.cornerCount == 3) {
            if (p.x + p.y == kGridSize) {
                return keyOnSide(q, 1, p.y);
            }
        } else if (p.x == kGridSize) {
            return keyOnSide(q, 1, p.y);
        } else if (p.y == kGridSize) {
            return keyOnSide(q, 2, kGridSize - p.x);
        }
        return {(static_cast<std::uint64_t>(p.x) << 32) | p.y, patch};
    }

    /// Whether the key's point belongs to one patch alone.
    static bool isInside(const PointKey& key) { return (key.where & kEdgeKey) == 0; }

  private:
    static constexpr std::uint32_t kEdgeKey = 0x80000000u;
    static constexpr std::uint32_t kCornerKey = 0xffffffffu;

    /// An edge and the direction in which it is meant.
    struct EdgeUse {
        std::uint32_t edge = kNone;
        bool reversed = false;
    };
    struct Edge {
        std::uint32_t from = 0;
        std::uint32_t to = 0;
        Vec3d middle{};
        bool straight = true;
        std::uint32_t patchCount = 0;
        std::uint32_t nextWithSameEnds = kNone;
        /// Where it is cut at a corner in its middle.
        std::uint32_t middleCorner = kNone;
        std::array<EdgeUse, 2> halves{};
    };
    struct Patch {
        std::uint32_t cornerCount = 4;
        std::array<EdgeUse, 4> sides{};
    };
    class Builder;

    /// `t` runs from 0 to kGridSize along the side, from its first corner.
    PointKey keyOnSide(const Patch& patch, std::uint32_t side, std::uint64_t t) const;

    const surface::Surface& surface_;
    std::vector<Patch> patches_;
    std::vector<Edge> edges_;
    std::vector<Vec3d> corners_;
    std::array<bool, 2> hasTexcoords_{};
};

}  // namespace fluxwalk::display
