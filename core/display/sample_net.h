#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/display/cell_shape.h"
#include "core/display/mesh_vertices.h"

namespace fluxwalk::display {

/// Where a cell stands in a SampleNet: samples at its corners, the edges of its sides, and the sample in the
/// middle, kNone as long as nobody asked for it.
struct CellNet {
    std::array<std::uint32_t, 4> corners{};
    /// Between corners k and k + 1: twice the number of the edge, plus 1 where it is meant the other way.
    std::array<std::uint32_t, 4> sides{};
    std::uint32_t center = kNone;
};

/// The surface at corners, middles of edges and middles of cells that are cut again and again. Every point is
/// evaluated once, whichever cells share it, and cells find what lies on their sides without a search: halves
/// of an edge are edges, and cells on both sides of one know it by the same number, over the borders of
/// patches too. An edge is split where its middle is a vertex.
class SampleNet {
  public:
    /// Begins anew, in the memory that it has, for cells whose vertices are those of `mesh`. The topology
    /// stays.
    void reset(const PatchTopology& topology, const MeshVertices& mesh);

    /// A cell of that mesh: `own` are its vertices.
    CellNet addRoot(const Cell& cell, const CellVertices& own, const surface::Region& region);

    /// Both halves of a quad, as halfOf() and halfRegions() order them.
    std::array<CellNet, 2> halve(CellNet& net, Axis axis);
    /// The quarters of a triangle, as partOf() orders them.
    std::array<CellNet, 4> quarter(CellNet& net);
    /// Makes the middle of the edge between both halves of a quad a vertex.
    void splitBetween(const CellNet& firstHalf, Axis axis);

    /// Samples in the middle of a side and of a quad.
    std::uint32_t middleOf(const CellNet& net, unsigned side, unsigned cornerCount);
    std::uint32_t centerOf(CellNet& net);

    bool isSplit(std::uint32_t side) const { return edges_[side / 2].halves[0] != kNone; }
    /// Whether more than one vertex lies between the ends of a side.
    bool isCrowded(std::uint32_t side) const {
        const Edge& edge = edges_[side / 2];
        return edge.halves[0] != kNone && (isSplit(edge.halves[0]) || isSplit(edge.halves[1]));
    }
    /// The vertex in the middle of a side that is split.
    std::uint32_t vertexOn(const CellNet& net, unsigned side, unsigned cornerCount);

    surface::Region regionOf(const CellNet& net, unsigned cornerCount) const;
    const std::vector<SurfaceSample>& samples() const { return samples_; }
    std::uint32_t pointCount() const { return pointCount_; }

  private:
    struct Edge {
        /// Uses of both halves from its first end on, kNone until it is split.
        std::array<std::uint32_t, 2> halves{kNone, kNone};
        std::uint32_t point = kNone;   ///< in its middle
        std::uint32_t sample = kNone;  ///< the first there
        bool isBorder = false;  ///< of a patch: other patches, or others of its sides, may have samples
    };
    /// An edge of the mesh that was given, by its ends; others may have the same middle.
    struct RootEdge {
        std::array<std::uint32_t, 2> ends{};
        std::uint32_t edge = 0;
        std::uint32_t next = kNone;
    };

    std::uint32_t rootUse(std::uint32_t patch, const GridPoint& a, const GridPoint& b, std::uint32_t from,
                          std::uint32_t to);
    std::uint32_t addSample(std::uint32_t patch, const Vec2d& uv);
    std::uint32_t addEdge(bool isBorder);
    /// Half 0 or 1 of a split side in its own direction.
    std::uint32_t halfOf(std::uint32_t side, unsigned half) const {
        const Edge& edge = edges_[side / 2];
        return side % 2 == 0 ? edge.halves[half] : edge.halves[1 - half] ^ 1u;
    }
    void split(std::uint32_t edge);
    std::uint32_t splitSide(const CellNet& net, unsigned side, unsigned cornerCount);
    std::uint32_t addInnerEdge(std::uint32_t from, std::uint32_t to, std::uint32_t middle);

    const PatchTopology* topology_ = nullptr;
    const surface::Surface* surface_ = nullptr;
    std::vector<SurfaceSample> samples_;
    std::vector<Edge> edges_;
    std::uint32_t pointCount_ = 0;
    /// First sample of each vertex of the mesh that was given; of its edges by their middles.
    std::vector<std::uint32_t> sampleOfVertex_;
    PointTable rootMiddles_{0};
    std::vector<std::uint32_t> firstRoot_;
    std::vector<RootEdge> roots_;
};

}  // namespace fluxwalk::display
