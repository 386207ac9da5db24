#include "core/display/carry_values.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fluxwalk::display {

namespace {

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
        scale_ = 1.0 / base::Vec2d(cell_.extent.x, cell_.extent.y);
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
    base::Vec2d scale_{1.0};
};

}  // namespace

CarryPlan planCarrying(std::span<const Cell> cells, const MeshVertices& fine) {
    CarryPlan plan;
    plan.samples.assign(fine.pointOfValue.size() + cells.size(), {});
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::array<GridPoint, 4> corners = cornersOf(cells[i]);
        const auto set = [&](std::size_t sample, const GridPoint& at) {
            if (plan.samples[sample].source == kNone) {
                plan.samples[sample] = {cells[i].source, at};
            }
        };
        for (unsigned k = 0; k < cells[i].cornerCount; ++k) {
            set(fine.vertices[fine.cells[i].corners[k]].value, corners[k]);
            if (fine.cells[i].middles[k] != kNone) {
                set(fine.vertices[fine.cells[i].middles[k]].value,
                    middleOf(corners[k], corners[(k + 1) % cells[i].cornerCount]));
            }
        }
        if (fine.cells[i].isFan) {
            set(fine.pointOfValue.size() + i, middleOf(corners[0], corners[2]));
        }
    }
    return plan;
}

MeshValues carryValues(const ValuedMesh& coarse, const CarryPlan& plan, std::size_t valueCount) {
    MeshValues out;
    out.values.assign(valueCount, Rgb(0.0f));
    out.centers.assign(plan.samples.size() - valueCount, Rgb(0.0f));
    std::optional<CellReader> reader;
    std::uint32_t readerOf = kNone;
    for (std::size_t i = 0; i < plan.samples.size(); ++i) {
        const CarryPlan::Sample& sample = plan.samples[i];
        if (sample.source != kNone) {
            Rgb& value = i < valueCount ? out.values[i] : out.centers[i - valueCount];
            if (!reader || readerOf != sample.source) {
                reader.emplace(coarse, sample.source);
                readerOf = sample.source;
            }
            value = reader->at(sample.at);
        }
    }
    return out;
}

}  // namespace fluxwalk::display
