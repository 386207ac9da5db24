#include "core/surface/dual_cage.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/common.hpp>

namespace fluxwalk::surface {

namespace {

constexpr unsigned kFewestCells = 3;
constexpr unsigned kMostCells = 24;
constexpr unsigned kRounds = 12;
/// Places of the grid that are tried for each size of its cubes.
constexpr unsigned kShifts = 8;
/// How far from folding the map must stay for few quadrature points to see its measure.
constexpr double kLeastCosine = 0.5;
constexpr double kLeastGrowth = 0.25;

class Grid {
  public:
    Grid(const SmoothUnion& object, unsigned cells, const Vec3d& shift) : object_(object) {
        const Box box = object.bounds();
        const Vec3d size = box.size();
        step_ = std::max({size.x, size.y, size.z}) / cells;
        for (int i = 0; i < 3; ++i) {
            // One cube more on each side and one for the shift, so that the outermost nodes lie outside.
            const auto count = static_cast<unsigned>(std::ceil(size[i] / step_));
            nodes_[static_cast<std::size_t>(i)] = count + 4;
            origin_[i] = box.center()[i] - (0.5 * count + 1.0 + shift[i]) * step_;
        }
        inside_.resize(static_cast<std::size_t>(nodes_[0]) * nodes_[1] * nodes_[2]);
        for (unsigned z = 0; z < nodes_[2]; ++z) {
            for (unsigned y = 0; y < nodes_[1]; ++y) {
                for (unsigned x = 0; x < nodes_[0]; ++x) {
                    inside_[index({x, y, z})] = object.value(position({x, y, z})) < 0.0 ? 1 : 0;
                }
            }
        }
    }

    Cage dualFaces() {
        Cage cage;
        std::array<unsigned, 3> at{};
        for (at[2] = 1; at[2] + 1 < nodes_[2]; ++at[2]) {
            for (at[1] = 1; at[1] + 1 < nodes_[1]; ++at[1]) {
                for (at[0] = 1; at[0] + 1 < nodes_[0]; ++at[0]) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        addFace(cage, at, axis);
                    }
                }
            }
        }
        return cage;
    }

  private:
    using Node = std::array<unsigned, 3>;

    std::size_t index(const Node& at) const {
        return (static_cast<std::size_t>(at[2]) * nodes_[1] + at[1]) * nodes_[0] + at[0];
    }
    Vec3d position(const Node& at) const { return origin_ + step_ * Vec3d(at[0], at[1], at[2]); }
    bool isInside(const Node& at) const { return inside_[index(at)] != 0; }

    // The edge from a node along an axis, where it crosses the surface, is surrounded by four cubes.
    void addFace(Cage& cage, const Node& at, std::size_t axis) {
        Node next = at;
        ++next[axis];
        if (isInside(at) == isInside(next)) {
            return;
        }
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> face{};
        // Counter-clockwise about the axis: about the way out where this node is inside.
        constexpr std::array<std::array<unsigned, 2>, 4> kAround{{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
        for (std::size_t k = 0; k < 4; ++k) {
            Node cube = at;
            cube[u] -= kAround[k][0];
            cube[v] -= kAround[k][1];
            face[isInside(at) ? k : 3 - k] = vertexOf(cage, cube);
        }
        cage.faces.push_back(face);
    }

    // Mean of the crossings of the cube's edges.
    std::uint32_t vertexOf(Cage& cage, const Node& cube) {
        const auto [entry, isNew] =
            vertices_.try_emplace(index(cube), static_cast<std::uint32_t>(cage.vertices.size()));
        if (!isNew) {
            return entry->second;
        }
        Vec3d sum(0.0);
        double count = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (unsigned k = 0; k < 4; ++k) {
                Node from = cube;
                from[(axis + 1) % 3] += k & 1u;
                from[(axis + 2) % 3] += k >> 1u;
                Node to = from;
                ++to[axis];
                if (isInside(from) != isInside(to)) {
                    const double a = object_.value(position(from));
                    const double b = object_.value(position(to));
                    sum += position(from) + a / (a - b) * (position(to) - position(from));
                    count += 1.0;
                }
            }
        }
        cage.vertices.push_back(sum / count);
        return entry->second;
    }

    const SmoothUnion& object_;
    double step_ = 0.0;
    Vec3d origin_{};
    Node nodes_{};
    std::vector<std::uint8_t> inside_;
    std::map<std::size_t, std::uint32_t> vertices_;
};

// Whether each edge belongs to two faces that run along it in opposite directions.
bool isManifold(const Cage& cage) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& face : cage.faces) {
        for (std::size_t k = 0; k < 4; ++k) {
            ++uses[{face[k], face[(k + 1) % 4]}];
        }
    }
    return std::all_of(uses.begin(), uses.end(), [&](const auto& entry) {
        const auto opposite = uses.find({entry.first.second, entry.first.first});
        return entry.second == 1 && opposite != uses.end() && opposite->second == 1;
    });
}

// Draws each vertex towards the mean of its neighbours and back onto the surface. False where one gets lost.
bool evenOut(const SmoothUnion& object, Cage& cage) {
    for (unsigned round = 0; round < kRounds; ++round) {
        std::vector<Vec3d> sum(cage.vertices.size(), Vec3d(0.0));
        std::vector<double> count(cage.vertices.size(), 0.0);
        for (const auto& face : cage.faces) {
            for (std::size_t k = 0; k < 4; ++k) {
                sum[face[k]] += cage.vertices[face[(k + 1) % 4]];
                count[face[k]] += 1.0;
            }
        }
        for (std::size_t i = 0; i < cage.vertices.size(); ++i) {
            const Vec3d target = 0.5 * (cage.vertices[i] + sum[i] / count[i]);
            const auto snapped = object.closestPoint(target);
            if (!snapped) {
                return false;
            }
            cage.vertices[i] = snapped->position;
        }
    }
    return true;
}

}  // namespace

std::optional<Cage> buildDualCage(const std::shared_ptr<const SmoothUnion>& object) {
    for (unsigned cells = kFewestCells; cells <= kMostCells; ++cells) {
        for (unsigned k = 0; k < kShifts; ++k) {
            // Well spread in the unit cube (the R3 sequence, M. Roberts 2018).
            const Vec3d shift = glm::fract(static_cast<double>(k) *
                                           Vec3d(0.8191725133961645, 0.6710436067037893, 0.5497004779019703));
            Cage cage = Grid(*object, cells, shift).dualFaces();
            if (cage.faces.empty() || !isManifold(cage) || !evenOut(*object, cage)) {
                continue;
            }
            const ProjectionCount count = ProjectedSurface(object, cage).projectionCount();
            if (count.unsnapped == 0 && count.closest == 0 && count.leastCosine >= kLeastCosine &&
                count.leastGrowth >= kLeastGrowth) {
                return cage;
            }
        }
    }
    return std::nullopt;
}

}  // namespace fluxwalk::surface
