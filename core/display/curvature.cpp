#include "core/display/curvature.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::display {

namespace {

using surface::Region;

class CurvatureSplitter {
  public:
    CurvatureSplitter(const PatchTopology& topology, double angle)
        : topology_(topology), surface_(topology.surface()), angle_(angle) {}

    std::vector<Cell> run(std::span<const Cell> cells) {
        std::vector<Cell> out;
        bool isSplit = false;
        for (std::uint32_t i = 0; i < cells.size(); ++i) {
            const Cell& cell = cells[i];
            const std::size_t before = out.size();
            if (surface_.isPlanar(cell.patch)) {
                out.push_back(makeCell(topology_, cell.patch, cell.path, i));
            } else {
                split(cell, i, cell.path, surface::regionOf(surface_, cell.patch, cell.path), kMaxExtraLevels,
                      out);
            }
            isSplit = isSplit || out.size() > before + 1;
        }
        return isSplit ? out : std::vector<Cell>{};
    }

  private:
    void split(const Cell& cell, std::uint32_t source, surface::Path path, const Region& region,
               unsigned levels, std::vector<Cell>& out) const {
        if (levels == 0 || surface::pathLevel(path) == surface::kMaxLevel ||
            (surface_.bounds(cell.patch, region).normals.halfAngle <= angle_ &&
             !hasBentEdge(cell.patch, region))) {
            out.push_back(makeCell(topology_, cell.patch, path, source));
            return;
        }
        const std::array<Region, 4> quarters = surface::childRegions(surface_, cell.patch, region);
        for (unsigned k = 0; k < 4; ++k) {
            split(cell, source, surface::childPath(path, k), quarters[k], levels - 1, out);
        }
    }

    // Whether an edge turns by more than twice the angle, as a disk's rim does though its normals do not.
    bool hasBentEdge(std::uint32_t patch, const Region& region) const {
        std::array<Vec3d, 4> corners{};
        for (unsigned k = 0; k < region.cornerCount; ++k) {
            corners[k] = surface_.evaluate(patch, region.corners[k]).position;
        }
        for (unsigned k = 0; k < region.cornerCount; ++k) {
            const unsigned next = (k + 1) % region.cornerCount;
            const base::Vec2d uv = surface_.splitPoint(patch, region.corners[k], region.corners[next]);
            const double halfChord = 0.5 * glm::distance(corners[k], corners[next]);
            const double sagitta =
                glm::distance(surface_.evaluate(patch, uv).position, 0.5 * (corners[k] + corners[next]));
            // An arc that turns by 2 a has a sagitta of tan(a / 2) half chords.
            if (sagitta > std::tan(0.5 * std::min(angle_, 3.0)) * halfChord) {
                return true;
            }
        }
        return false;
    }

    const PatchTopology& topology_;
    const surface::Surface& surface_;
    double angle_;
};

/// Reads one coarse cell at coordinates of its own, which run from 0 at corner 0 to 1 at its neighbours.
class CellReader {
  public:
    CellReader(const ValuedMesh& mesh, std::uint32_t index) : cell_(mesh.cells[index]) {
        const CellVertices& own = mesh.vertices.cells[index];
        const unsigned count = cell_.cornerCount;
        for (unsigned k = 0; k < count; ++k) {
            corners_[k] = mesh.values.values[mesh.vertices.vertices[own.corners[k]].value];
        }
        for (unsigned k = 0; k < count; ++k) {
            middles_[k] = own.middles[k] != kNone
                              ? mesh.values.values[mesh.vertices.vertices[own.middles[k]].value]
                              : 0.5f * (corners_[k] + corners_[(k + 1) % count]);
        }
        center_ = mesh.values.centers[index];
        // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): bit_width is unknown to it
        scale_ = 1.0 / (kGridSize >> surface::pathLevel(cell_.path));
    }

    Rgb at(const GridPoint& p) const {
        const base::Vec2d local =
            scale_ * base::Vec2d(offset(p.x, cell_.origin.x), offset(p.y, cell_.origin.y));
        return cell_.cornerCount == 4 ? inQuad(local) : inTriangle(local);
    }

  private:
    double offset(std::uint32_t to, std::uint32_t from) const {
        return cell_.inverted ? static_cast<double>(from) - to : static_cast<double>(to) - from;
    }

    // Along side k, piecewise linear by way of its middle.
    Rgb onSide(unsigned k, double t) const {
        const Rgb& end = corners_[(k + 1) % cell_.cornerCount];
        return t <= 0.5 ? glm::mix(corners_[k], middles_[k], static_cast<float>(2.0 * t))
                        : glm::mix(middles_[k], end, static_cast<float>(2.0 * t - 1.0));
    }

    // A fan about the middle, as it is triangulated: rays from there through the point meet a side.
    Rgb inQuad(const base::Vec2d& local) const {
        const base::Vec2d d = 2.0 * local - base::Vec2d(1.0);
        const double reach = std::max(std::abs(d.x), std::abs(d.y));
        if (reach <= 0.0) {
            return center_;
        }
        const base::Vec2d hit = d / reach;
        unsigned side = 0;
        double t = 0.0;
        if (std::abs(d.y) >= std::abs(d.x)) {
            side = d.y < 0.0 ? 0 : 2;
            t = side == 0 ? 0.5 * (hit.x + 1.0) : 0.5 * (1.0 - hit.x);
        } else {
            side = d.x > 0.0 ? 1 : 3;
            t = side == 1 ? 0.5 * (hit.y + 1.0) : 0.5 * (1.0 - hit.y);
        }
        return glm::mix(center_, onSide(side, t), static_cast<float>(reach));
    }

    // In its quarters, whose middles are those of its sides.
    Rgb inTriangle(const base::Vec2d& local) const {
        const double u = local.x;
        const double v = local.y;
        const double w = 1.0 - u - v;
        const auto blend = [](double a, const Rgb& p, double b, const Rgb& q, double c, const Rgb& r) {
            return static_cast<float>(a) * p + static_cast<float>(b) * q + static_cast<float>(c) * r;
        };
        if (w >= 0.5) {
            return blend(2.0 * w - 1.0, corners_[0], 2.0 * u, middles_[0], 2.0 * v, middles_[2]);
        }
        if (u >= 0.5) {
            return blend(2.0 * u - 1.0, corners_[1], 2.0 * v, middles_[1], 2.0 * w, middles_[0]);
        }
        if (v >= 0.5) {
            return blend(2.0 * v - 1.0, corners_[2], 2.0 * w, middles_[2], 2.0 * u, middles_[1]);
        }
        return blend(1.0 - 2.0 * v, middles_[0], 1.0 - 2.0 * w, middles_[1], 1.0 - 2.0 * u, middles_[2]);
    }

    const Cell& cell_;
    std::array<Rgb, 4> corners_{};
    std::array<Rgb, 4> middles_{};
    Rgb center_{};
    double scale_ = 1.0;
};

}  // namespace

std::vector<Cell> refineByCurvature(const PatchTopology& topology, std::span<const Cell> cells,
                                    double angle) {
    return CurvatureSplitter(topology, angle).run(cells);
}

MeshValues carryValues(const ValuedMesh& coarse, std::span<const Cell> cells, const MeshVertices& fine) {
    MeshValues out;
    out.values.assign(fine.pointOfValue.size(), Rgb(0.0f));
    out.centers.assign(cells.size(), Rgb(0.0f));
    std::vector<bool> isSet(fine.pointOfValue.size(), false);
    std::size_t i = 0;
    while (i < cells.size()) {
        const std::uint32_t source = cells[i].source;
        const CellReader reader(coarse, source);
        for (; i < cells.size() && cells[i].source == source; ++i) {
            const std::array<GridPoint, 4> corners = cornersOf(cells[i]);
            const auto set = [&](std::uint32_t vertex, const GridPoint& at) {
                const std::uint32_t value = fine.vertices[vertex].value;
                if (!isSet[value]) {
                    isSet[value] = true;
                    out.values[value] = reader.at(at);
                }
            };
            for (unsigned k = 0; k < cells[i].cornerCount; ++k) {
                set(fine.cells[i].corners[k], corners[k]);
                if (fine.cells[i].middles[k] != kNone) {
                    set(fine.cells[i].middles[k],
                        middleOf(corners[k], corners[(k + 1) % cells[i].cornerCount]));
                }
            }
            if (cells[i].cornerCount == 4) {
                out.centers[i] = reader.at(middleOf(corners[0], corners[2]));
            }
        }
    }
    return out;
}

}  // namespace fluxwalk::display
