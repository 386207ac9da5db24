#include "core/display/mesh_vertices.h"

#include <cmath>

#include "core/display/cell_regions.h"

namespace fluxwalk::display {

namespace {

using surface::Region;

/// Cuts of a curved leaf after which its light is nearly linear in each part.
constexpr unsigned kCutsForTwo = 2;

class Collector {
  public:
    Collector(const PatchTopology& topology, const PointTable& points, const std::vector<Cell>& cells)
        : topology_(topology), points_(points), cells_(cells) {}

    MeshVertices run(double creaseAngle) {
        const surface::Surface& surface = topology_.surface();
        out_.positions.resize(points_.size());
        out_.heads.assign(points_.size(), kNone);
        out_.vertices.reserve(points_.size() + points_.size() / 4);
        out_.cells.resize(cells_.size());
        out_.centers.resize(cells_.size());
        RegionCursor cursor(surface);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const Cell& cell = cells_[i];
            const Region& region = cursor.at(cell);
            CellVertices& own = out_.cells[i];
            for (unsigned k = 0; k < cell.cornerCount; ++k) {
                own.corners[k] = vertexAt(cell.points[k], cell.patch, [&] { return region.corners[k]; });
            }
            for (unsigned k = 0; k < cell.cornerCount; ++k) {
                const unsigned next = k + 1 == cell.cornerCount ? 0 : k + 1;
                if (cell.middles[k] != kNone) {
                    own.middles[k] = vertexAt(cell.middles[k], cell.patch, [&] {
                        return surface.splitPoint(cell.patch, region.corners[k], region.corners[next]);
                    });
                }
            }
            own.isFan = cell.cornerCount == 4 &&
                        (surface::pathLevel(cell.cuts) < kCutsForTwo || surface.isPlanar(cell.patch) ||
                         own.middles != CellVertices{}.middles);
            if (own.isFan) {
                // As quartering would find it.
                out_.centers[i] = surface.splitPoint(
                    cell.patch, surface.splitPoint(cell.patch, region.corners[3], region.corners[0]),
                    surface.splitPoint(cell.patch, region.corners[1], region.corners[2]));
            }
        }
        numberValues(std::cos(creaseAngle));
        return std::move(out_);
    }

  private:
    template <class FindUv>
    std::uint32_t vertexAt(std::uint32_t point, std::uint32_t patch, const FindUv& findUv) {
        std::uint32_t last = kNone;
        for (std::uint32_t v = out_.heads[point]; v != kNone; v = out_.vertices[v].next) {
            if (out_.vertices[v].patch == patch) {
                return v;
            }
            last = v;
        }
        const auto number = static_cast<std::uint32_t>(out_.vertices.size());
        Vertex vertex;
        vertex.point = point;
        vertex.patch = patch;
        vertex.uv = findUv();
        if (last != kNone && patch == flatPatch_) {
            vertex.normal = flatNormal_;
        } else {
            const surface::SurfacePoint at = topology_.surface().evaluate(patch, vertex.uv);
            vertex.normal = Vec3(at.normal);
            if (last == kNone) {
                out_.positions[point] = at.position;
            }
            if (topology_.surface().isPlanar(patch)) {
                flatPatch_ = patch;
                flatNormal_ = vertex.normal;
            }
        }
        (last == kNone ? out_.heads[point] : out_.vertices[last].next) = number;
        out_.vertices.push_back(vertex);
        return number;
    }

    void numberValues(double leastCosine) {
        // Rounding must not make a crease of equal normals.
        const auto limit = static_cast<float>(leastCosine - 1e-6);
        out_.pointOfValue.reserve(out_.vertices.size());
        for (std::uint32_t point = 0; point < out_.heads.size(); ++point) {
            // Each vertex that has no value yet starts one and spreads it.
            for (std::uint32_t v = out_.heads[point]; v != kNone; v = out_.vertices[v].next) {
                if (out_.vertices[v].value == kNone) {
                    const auto value = static_cast<std::uint32_t>(out_.pointOfValue.size());
                    out_.pointOfValue.push_back(point);
                    out_.vertices[v].value = value;
                    if (out_.vertices[v].next != kNone) {
                        spread(v, limit);
                    }
                }
            }
        }
    }

    void spread(std::uint32_t start, float limit) {
        stack_.assign(1, start);
        while (!stack_.empty()) {
            const Vertex from = out_.vertices[stack_.back()];
            stack_.pop_back();
            for (std::uint32_t v = out_.heads[from.point]; v != kNone; v = out_.vertices[v].next) {
                Vertex& other = out_.vertices[v];
                if (other.value == kNone && glm::dot(from.normal, other.normal) >= limit) {
                    other.value = from.value;
                    stack_.push_back(v);
                }
            }
        }
    }

    const PatchTopology& topology_;
    const PointTable& points_;
    const std::vector<Cell>& cells_;
    MeshVertices out_;
    /// The planar patch seen last, and its normal.
    std::uint32_t flatPatch_ = kNone;
    Vec3 flatNormal_{};
    std::vector<std::uint32_t> stack_;
};

}  // namespace

MeshVertices collectVertices(const PatchTopology& topology, const PointTable& points,
                             const std::vector<Cell>& cells, double creaseAngle) {
    return Collector(topology, points, cells).run(creaseAngle);
}

}  // namespace fluxwalk::display
