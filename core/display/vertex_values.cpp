#include "core/display/vertex_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "core/base/check.h"

namespace fluxwalk::display {

namespace {

/// How far a vertex may leave the range of its leaves and their neighbours: upwards by a part of that range,
/// downwards by less, and no more than a part of the least value, as dark fringes beside shadows' edges would
/// be seen. (Chosen by display error on known irradiances, with the weights below, and by eye.)
constexpr float kUpperMargin = 0.1f;
constexpr float kLowerMargin = 0.05f;
/// Length of the mean direction from a vertex to its cells: on a straight border of squares, and where it
/// begins to count as a border (hanging vertices have 0.14).
constexpr float kBorderBias = 0.7071f;
constexpr float kInnerBias = 0.28f;
/// Added to the diagonal of the normal equations, relative to their trace: leaves in one row have no gradient
/// across it.
constexpr float kRidge = 1e-6f;

/// A leaf of the solution: the centroid, where its mean is the value of a linear function, and a frame in its
/// plane. Positions are relative to one of the mesh's: float serves.
struct Sample {
    Vec3 center{};
    Vec3 tangent{};
    Vec3 bitangent{};
    float size = 0.0f;  ///< metres
    float exposed = 1.0f;
    Rgb irradiance{};
    std::array<Rgb, 2> gradient{};  ///< lux per metre along tangent and bitangent
    /// Range of the leaf, its neighbours, and what it extrapolates to on borders.
    Rgb least{};
    Rgb most{};
    std::uint32_t firstCell = 0;
    std::uint32_t lastCell = 0;

    base::Vec2 inFrame(const Vec3& p) const {
        const Vec3 d = p - center;
        return {glm::dot(d, tangent), glm::dot(d, bitangent)};
    }
    Rgb rise(const Vec3& p) const {
        const base::Vec2 d = inFrame(p);
        return d.x * gradient[0] + d.y * gradient[1];
    }
};

Vec3 directionTo(const Vec3& d) {
    const float squared = glm::dot(d, d);
    return squared > 0.0f ? d / std::sqrt(squared) : Vec3(0.0f);
}

class Reconstruction {
  public:
    Reconstruction(std::span<const Cell> cells, const MeshVertices& mesh, std::span<const Leaf> leaves)
        : cells_(cells), mesh_(mesh), origin_(mesh.positions.front()) {
        makeSamples(leaves);
        findIncident();
    }

    MeshValues run() {
        for (std::uint32_t s = 0; s < samples_.size(); ++s) {
            fitGradient(s);
            widenAtBorders(samples_[s]);
        }
        MeshValues out;
        out.values.reserve(mesh_.pointOfValue.size());
        for (std::uint32_t v = 0; v < mesh_.pointOfValue.size(); ++v) {
            out.values.push_back(valueAt(v));
        }
        out.centers.reserve(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            out.centers.push_back(centerOf(i, out.values));
        }
        return out;
    }

  private:
    Vec3 positionOf(std::uint32_t point) const { return Vec3(mesh_.positions[point] - origin_); }
    Vec3 corner(const Cell& cell, unsigned i) const { return positionOf(cell.points[i]); }

    Vec3 middleOfCell(const Cell& cell) const {
        const Vec3 three = corner(cell, 0) + corner(cell, 1) + corner(cell, 2);
        return cell.cornerCount == 3 ? three / 3.0f : 0.25f * (three + corner(cell, 3));
    }

    void makeSamples(std::span<const Leaf> leaves) {
        samples_.resize(leaves.size());
        std::uint32_t cell = 0;
        for (std::uint32_t s = 0; s < samples_.size(); ++s) {
            Sample& sample = samples_[s];
            sample.irradiance = leaves[s].irradiance;
            sample.exposed = leaves[s].exposed;
            sample.firstCell = cell;
            Vec3 normal(0.0f);
            Vec3 moment(0.0f);
            float weights = 0.0f;
            for (; cell < cells_.size() && cells_[cell].source == s; ++cell) {
                for (unsigned i = 2; i < cells_[cell].cornerCount; ++i) {
                    const Vec3 a = corner(cells_[cell], 0);
                    const Vec3 b = corner(cells_[cell], i - 1);
                    const Vec3 c = corner(cells_[cell], i);
                    const Vec3 across = glm::cross(b - a, c - a);
                    const float weight = glm::length(across);
                    normal += across;
                    moment += weight * (a + b + c);
                    weights += weight;
                }
            }
            sample.lastCell = cell;
            FLUXWALK_CHECK_LT(sample.firstCell, sample.lastCell);
            const Cell& first = cells_[sample.firstCell];
            sample.center = weights > 0.0f ? moment / (3.0f * weights) : corner(first, 0);
            sample.size = std::sqrt(0.5f * weights);
            const Vec3 along = corner(first, 1) - corner(first, 0);
            const Vec3 across = glm::cross(normal, along);
            const float length = glm::length(across);
            if (length > 0.0f) {
                sample.bitangent = across / length;
                sample.tangent = glm::normalize(glm::cross(sample.bitangent, normal));
            }
        }
    }

    template <class Visit>
    void forValues(std::size_t cell, const Visit& visit) const {
        const CellVertices& own = mesh_.cells[cell];
        for (unsigned i = 0; i < 4; ++i) {
            if (own.corners[i] != kNone) {
                visit(mesh_.vertices[own.corners[i]].value);
            }
            if (own.middles[i] != kNone) {
                visit(mesh_.vertices[own.middles[i]].value);
            }
        }
    }

    // Leaves around each value, in one array, and whether cells surround it.
    void findIncident() {
        const std::size_t valueCount = mesh_.pointOfValue.size();
        begin_.assign(valueCount + 1, 0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            forValues(i, [&](std::uint32_t v) { ++begin_[v + 1]; });
        }
        for (std::size_t v = 0; v < valueCount; ++v) {
            begin_[v + 1] += begin_[v];
        }
        incident_.resize(begin_[valueCount]);
        end_.assign(begin_.begin(), begin_.end() - 1);
        std::vector<Vec3> towardsCells(valueCount, Vec3(0.0f));
        std::vector<float> cellsAround(valueCount, 0.0f);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const std::uint32_t source = cells_[i].source;
            const Vec3 center = middleOfCell(cells_[i]);
            const float exposed = samples_[source].exposed;
            forValues(i, [&](std::uint32_t v) {
                towardsCells[v] += exposed * directionTo(center - positionOf(mesh_.pointOfValue[v]));
                cellsAround[v] += exposed;
                // Cells of one leaf follow each other: it was added last if it was added at all.
                if (end_[v] == begin_[v] || incident_[end_[v] - 1] != source) {
                    incident_[end_[v]++] = source;
                }
            });
        }
        border_.resize(valueCount);
        for (std::size_t v = 0; v < valueCount; ++v) {
            const float bias = cellsAround[v] > 0.0f ? glm::length(towardsCells[v]) / cellsAround[v] : 0.0f;
            border_[v] = glm::clamp((bias - kInnerBias) / (kBorderBias - kInnerBias), 0.0f, 1.0f);
        }
    }

    std::span<const std::uint32_t> incident(std::uint32_t value) const {
        return {incident_.data() + begin_[value], end_[value] - begin_[value]};
    }

    // Neighbours over an edge come twice, over a corner once. Weights fall with the distance squared, and
    // with the size of smaller neighbours, of which there are more.
    void fitGradient(std::uint32_t s) {
        Sample& sample = samples_[s];
        float xx = 0.0f;
        float xy = 0.0f;
        float yy = 0.0f;
        Rgb alongX(0.0f);
        Rgb alongY(0.0f);
        sample.least = sample.irradiance;
        sample.most = sample.irradiance;
        const auto addNeighbour = [&](const Sample& other) {
            const base::Vec2 d = sample.inFrame(other.center);
            const float squared = glm::dot(d, d);
            if (!(squared > 0.0f) || other.exposed <= 0.0f) {
                return;
            }
            const float weight = other.exposed * std::min(1.0f, other.size / sample.size) / squared;
            const Rgb rise = other.irradiance - sample.irradiance;
            const float x = weight * d.x;
            const float y = weight * d.y;
            xx += x * d.x;
            xy += x * d.y;
            yy += y * d.y;
            alongX += x * rise;
            alongY += y * rise;
            sample.least = glm::min(sample.least, other.irradiance);
            sample.most = glm::max(sample.most, other.irradiance);
        };
        for (std::uint32_t cell = sample.firstCell; cell < sample.lastCell; ++cell) {
            forValues(cell, [&](std::uint32_t v) {
                for (const std::uint32_t other : incident(v)) {
                    if (other != s) {
                        addNeighbour(samples_[other]);
                    }
                }
            });
        }
        const float ridge = kRidge * (xx + yy);
        xx += ridge;
        yy += ridge;
        const float determinant = xx * yy - xy * xy;
        if (determinant > 0.0f) {
            sample.gradient[0] = (yy * alongX - xy * alongY) / determinant;
            sample.gradient[1] = (xx * alongY - xy * alongX) / determinant;
        }
    }

    // On borders a leaf may be extrapolated by as much as its neighbourhood spans: a large leaf beside small
    // ones is as wide as the way to its neighbours on the other side.
    void widenAtBorders(Sample& sample) {
        const Rgb range = sample.most - sample.least;
        const Rgb least = sample.least;
        const Rgb most = sample.most;
        for (std::uint32_t cell = sample.firstCell; cell < sample.lastCell; ++cell) {
            forValues(cell, [&](std::uint32_t v) {
                if (border_[v] > 0.0f) {
                    const Rgb reach = border_[v] * range;
                    const Rgb value =
                        glm::clamp(sample.irradiance + sample.rise(positionOf(mesh_.pointOfValue[v])),
                                   least - reach, most + reach);
                    sample.least = glm::min(sample.least, value);
                    sample.most = glm::max(sample.most, value);
                }
            });
        }
    }

    Rgb valueAt(std::uint32_t value) const {
        const Vec3 p = positionOf(mesh_.pointOfValue[value]);
        const auto leaves = incident(value);
        std::size_t shown = 0;
        while (shown + 1 < leaves.size() && samples_[leaves[shown]].exposed <= 0.0f) {
            ++shown;
        }
        const Sample& first = samples_[leaves[shown]];
        // Sums of differences: those of a constant vanish exactly.
        Rgb sum(0.0f);
        Rgb least = first.least;
        Rgb most = first.most;
        float weights = 0.0f;
        for (const std::uint32_t s : leaves) {
            const Sample& sample = samples_[s];
            if (sample.exposed <= 0.0f) {
                continue;
            }
            sum += sample.exposed * ((sample.irradiance - first.irradiance) + sample.rise(p));
            weights += sample.exposed;
            least = glm::min(least, sample.least);
            most = glm::max(most, sample.most);
        }
        const Rgb mean = first.irradiance + (weights > 0.0f ? sum / weights : Rgb(0.0f));
        const Rgb range = most - least;
        const Rgb below = kLowerMargin * glm::min(range, glm::max(least, Rgb(0.0f)));
        return glm::max(glm::clamp(mean, least - below, most + kUpperMargin * range), Rgb(0.0f));
    }

    // The leaf's mean; in quarters of a leaf, what the leaf extrapolates to within the quarter's own corners.
    Rgb centerOf(std::size_t cell, const std::vector<Rgb>& values) const {
        const Sample& sample = samples_[cells_[cell].source];
        if (sample.lastCell - sample.firstCell == 1 || cells_[cell].cornerCount != 4) {
            return sample.irradiance;
        }
        Rgb low(std::numeric_limits<float>::infinity());
        Rgb high(0.0f);
        for (unsigned i = 0; i < 4; ++i) {
            const Rgb& value = values[mesh_.vertices[mesh_.cells[cell].corners[i]].value];
            low = glm::min(low, value);
            high = glm::max(high, value);
        }
        return glm::clamp(sample.irradiance + sample.rise(middleOfCell(cells_[cell])), low, high);
    }

    std::span<const Cell> cells_;
    const MeshVertices& mesh_;
    Vec3d origin_;
    std::vector<Sample> samples_;
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> end_;
    std::vector<std::uint32_t> incident_;
    /// Of values: 0 where cells surround the vertex, 1 on borders.
    std::vector<float> border_;
};

}  // namespace

MeshValues reconstructValues(std::span<const Cell> cells, const MeshVertices& mesh,
                             std::span<const Leaf> leaves) {
    return Reconstruction(cells, mesh, leaves).run();
}

}  // namespace fluxwalk::display
