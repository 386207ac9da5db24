#include "core/display/mesh_vertices.h"

#include <cmath>

#include "core/display/cell_regions.h"
#include "core/display/post_refine.h"

namespace fluxwalk::display {

namespace {

using surface::Region;

/// Cuts of a curved leaf after which its light is nearly linear in each part.
constexpr unsigned kCutsForTwo = 2;

class Collector {
  public:
    Collector(const PatchTopology& topology, std::uint32_t pointCount, const std::vector<Cell>& cells,
              MeshVertices& out)
        : surface_(topology.surface()), cells_(cells), out_(out) {
        out_.positions.resize(pointCount);
        out_.heads.assign(pointCount, kNone);
        out_.vertices.clear();
        out_.vertices.reserve(pointCount + pointCount / 4);
        out_.cells.assign(cells.size(), {});
        out_.centers.resize(cells.size());
        out_.pointOfValue.clear();
    }

    void evaluate() {
        RegionCursor cursor(surface_);
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
                        return surface_.splitPoint(cell.patch, region.corners[k], region.corners[next]);
                    });
                }
            }
            own.isFan = isFan(cell, surface_.isPlanar(cell.patch), own.middles != CellVertices{}.middles);
            if (own.isFan) {
                // As quartering would find it.
                out_.centers[i] = surface_.splitPoint(
                    cell.patch, surface_.splitPoint(cell.patch, region.corners[3], region.corners[0]),
                    surface_.splitPoint(cell.patch, region.corners[1], region.corners[2]));
            }
        }
    }

    void take(const RefinedCells& refined) {
        out_.centerPoints.resize(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const CellSamples& samples = refined.cellSamples[i];
            CellVertices& own = out_.cells[i];
            for (unsigned k = 0; k < cells_[i].cornerCount; ++k) {
                own.corners[k] = vertexOf(refined.samples[samples.corners[k]]);
            }
            for (unsigned k = 0; k < cells_[i].cornerCount; ++k) {
                if (samples.middles[k] != kNone) {
                    own.middles[k] = vertexOf(refined.samples[samples.middles[k]]);
                }
            }
            own.isFan = samples.center != kNone;
            if (own.isFan) {
                const SurfaceSample& center = refined.samples[samples.center];
                out_.centers[i] = center.uv;
                out_.centerPoints[i] = {center.position, center.normal};
            }
        }
    }

    void numberValues(double creaseAngle) {
        // Rounding must not make a crease of equal normals.
        const auto limit = static_cast<float>(std::cos(creaseAngle) - 1e-6);
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

  private:
    /// The vertex of a patch at a point, or the last of its vertices.
    struct Found {
        std::uint32_t vertex = kNone;
        std::uint32_t last = kNone;
    };
    Found find(std::uint32_t point, std::uint32_t patch) const {
        Found found;
        for (std::uint32_t v = out_.heads[point]; v != kNone; v = out_.vertices[v].next) {
            if (out_.vertices[v].patch == patch) {
                found.vertex = v;
                return found;
            }
            found.last = v;
        }
        return found;
    }

    std::uint32_t add(const Vertex& vertex, std::uint32_t last) {
        const auto number = static_cast<std::uint32_t>(out_.vertices.size());
        (last == kNone ? out_.heads[vertex.point] : out_.vertices[last].next) = number;
        out_.vertices.push_back(vertex);
        return number;
    }

    template <class FindUv>
    std::uint32_t vertexAt(std::uint32_t point, std::uint32_t patch, const FindUv& findUv) {
        const Found found = find(point, patch);
        if (found.vertex != kNone) {
            return found.vertex;
        }
        Vertex vertex;
        vertex.point = point;
        vertex.patch = patch;
        vertex.uv = findUv();
        if (found.last != kNone && patch == flatPatch_) {
            vertex.normal = flatNormal_;
        } else {
            const surface::SurfacePoint at = surface_.evaluate(patch, vertex.uv);
            vertex.normal = Vec3(at.normal);
            if (found.last == kNone) {
                out_.positions[point] = at.position;
            }
            if (surface_.isPlanar(patch)) {
                flatPatch_ = patch;
                flatNormal_ = vertex.normal;
            }
        }
        return add(vertex, found.last);
    }

    std::uint32_t vertexOf(const SurfaceSample& sample) {
        const Found found = find(sample.point, sample.patch);
        if (found.vertex != kNone) {
            return found.vertex;
        }
        if (found.last == kNone) {
            out_.positions[sample.point] = sample.position;
        }
        Vertex vertex;
        vertex.point = sample.point;
        vertex.patch = sample.patch;
        vertex.uv = sample.uv;
        vertex.normal = Vec3(sample.normal);
        return add(vertex, found.last);
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

    const surface::Surface& surface_;
    const std::vector<Cell>& cells_;
    MeshVertices& out_;
    /// The planar patch seen last, and its normal.
    std::uint32_t flatPatch_ = kNone;
    Vec3 flatNormal_{};
    std::vector<std::uint32_t> stack_;
};

}  // namespace

bool isFan(const Cell& cell, bool isPlanar, bool hasMiddles) {
    return cell.cornerCount == 4 && (surface::pathLevel(cell.cuts) < kCutsForTwo || isPlanar || hasMiddles);
}

MeshVertices collectVertices(const PatchTopology& topology, const PointTable& points,
                             const std::vector<Cell>& cells, double creaseAngle) {
    MeshVertices out;
    Collector collector(topology, points.size(), cells, out);
    collector.evaluate();
    collector.numberValues(creaseAngle);
    return out;
}

void collectVertices(const PatchTopology& topology, const RefinedCells& refined, double creaseAngle,
                     MeshVertices& out) {
    Collector collector(topology, refined.pointCount, refined.cells, out);
    collector.take(refined);
    collector.numberValues(creaseAngle);
}

}  // namespace fluxwalk::display
