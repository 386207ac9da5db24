#pragma once

#include <algorithm>
#include <map>
#include <set>

#include "core/surface/surface.h"
#include "tests/surface/cages.h"

/// Uniform subdivision as the papers of Catmull and Clark and of Loop state it, with infinitely sharp edges,
/// and the limit positions of vertices: an independent reference.
namespace fluxwalk::test {

using base::Vec2d;
using base::Vec3d;

class ReferenceMesh {
  public:
    struct Face {
        std::vector<std::uint32_t> corners;
        std::uint32_t patch = 0;
        std::vector<Vec2d> uv;
    };

    explicit ReferenceMesh(const ControlCage& cage)
        : isLoop_(cage.scheme == SubdivisionScheme::loop), positions_(cage.positions) {
        std::size_t first = 0;
        std::uint32_t patch = 0;
        for (const std::uint32_t count : cage.faceSizes) {
            Face face;
            face.corners.assign(cage.corners.begin() + static_cast<std::ptrdiff_t>(first),
                                cage.corners.begin() + static_cast<std::ptrdiff_t>(first + count));
            face.patch = patch;
            if (isLoop_) {
                face.uv = {{0, 0}, {1, 0}, {0, 1}};
            } else if (count == 4) {
                face.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            }
            patch += face.uv.empty() ? count : 1;
            faces_.push_back(face);
            first += count;
        }
        for (const surface::Crease& crease : cage.creases) {
            sharp_.insert(std::minmax(crease.from, crease.to));
        }
        connect();
    }

    const std::vector<Face>& faces() const { return faces_; }

    /// Vertices where one sharp edge ends: the masks below do not hold there.
    bool isDart(std::uint32_t v) const { return sharpNeighbours(v).size() == 1; }

    void subdivide() { isLoop_ ? subdivideLoop() : subdivideQuads(); }

    /// Vertices of the faces at a vertex.
    std::set<std::uint32_t> aroundOf(std::uint32_t v) const {
        std::set<std::uint32_t> result;
        for (const std::uint32_t f : facesAt_.at(v)) {
            result.insert(faces_[f].corners.begin(), faces_[f].corners.end());
        }
        return result;
    }

    /// Leaves two rings of faces about vertex 0, which keeps its name. After one more subdivision all but the
    /// outermost vertices are still as without this. For closed cages without creases.
    void keepAroundFirst() {
        const std::set<std::uint32_t> near = aroundOf(0);
        std::erase_if(faces_, [&](const Face& face) {
            return std::none_of(face.corners.begin(), face.corners.end(),
                                [&](std::uint32_t v) { return near.count(v) != 0; });
        });
        std::map<std::uint32_t, std::uint32_t> names{{0, 0}};
        std::vector<Vec3d> positions{positions_[0]};
        for (Face& face : faces_) {
            for (std::uint32_t& v : face.corners) {
                const auto [name, isNew] = names.try_emplace(v, static_cast<std::uint32_t>(positions.size()));
                if (isNew) {
                    positions.push_back(positions_[v]);
                }
                v = name->second;
            }
        }
        positions_ = positions;
        sharp_.clear();
        connect();
    }

    Vec3d limitOf(std::uint32_t v) const {
        const std::vector<std::uint32_t> sharp = sharpNeighbours(v);
        if (sharp.size() == 2 && !isCorner(v)) {
            return (4.0 * positions_[v] + positions_[sharp[0]] + positions_[sharp[1]]) / 6.0;
        }
        if (sharp.size() > 1) {
            return positions_[v];
        }
        const auto n = static_cast<double>(neighbours_.at(v).size());
        Vec3d ring(0.0);
        for (const std::uint32_t other : neighbours_.at(v)) {
            ring += positions_[other];
        }
        if (isLoop_) {
            const double weight = 1.0 / (3.0 / (8.0 * loopWeight(n)) + n);
            return (1.0 - n * weight) * positions_[v] + weight * ring;
        }
        Vec3d opposite(0.0);
        for (const std::uint32_t f : facesAt_.at(v)) {
            const std::vector<std::uint32_t>& c = faces_[f].corners;
            const auto at = std::find(c.begin(), c.end(), v) - c.begin();
            opposite += positions_[c[(static_cast<std::size_t>(at) + 2) % 4]];
        }
        return (n * n * positions_[v] + 4.0 * ring + opposite) / (n * (n + 5.0));
    }

  private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    static double loopWeight(double n) {
        const double c = 0.375 + 0.25 * std::cos(2.0 * base::kPi / n);
        return (0.625 - c * c) / n;
    }

    void connect() {
        neighbours_.clear();
        facesAt_.clear();
        facesOn_.clear();
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            const std::vector<std::uint32_t>& c = faces_[f].corners;
            for (std::size_t k = 0; k < c.size(); ++k) {
                const std::uint32_t a = c[k];
                const std::uint32_t b = c[(k + 1) % c.size()];
                neighbours_[a].insert(b);
                neighbours_[b].insert(a);
                facesAt_[a].push_back(f);
                facesOn_[std::minmax(a, b)].push_back(f);
            }
        }
        for (const auto& [edge, on] : facesOn_) {
            if (on.size() == 1) {
                sharp_.insert(edge);
            }
        }
    }

    // Of one face alone.
    bool isCorner(std::uint32_t v) const { return facesAt_.at(v).size() == 1; }

    std::vector<std::uint32_t> sharpNeighbours(std::uint32_t v) const {
        std::vector<std::uint32_t> result;
        for (const std::uint32_t other : neighbours_.at(v)) {
            if (sharp_.count(std::minmax(v, other)) != 0) {
                result.push_back(other);
            }
        }
        return result;
    }

    // New place of an old vertex on a crease or in a corner.
    std::optional<Vec3d> moveSharp(std::uint32_t v) const {
        const std::vector<std::uint32_t> sharp = sharpNeighbours(v);
        if (sharp.size() < 2) {
            return std::nullopt;
        }
        if (sharp.size() == 2 && !isCorner(v)) {
            return 0.75 * positions_[v] + 0.125 * (positions_[sharp[0]] + positions_[sharp[1]]);
        }
        return positions_[v];
    }

    // Adds a vertex for each edge, in `place`, and halves the sharp ones.
    template <class Rule>
    std::map<Edge, std::uint32_t> addEdgeVertices(std::vector<Vec3d>& positions, const Rule& rule) {
        std::map<Edge, std::uint32_t> added;
        std::set<Edge> sharp;
        for (const auto& [edge, on] : facesOn_) {
            const auto v = static_cast<std::uint32_t>(positions.size());
            const Vec3d sum = positions_[edge.first] + positions_[edge.second];
            const bool isSharp = sharp_.count(edge) != 0;
            positions.push_back(isSharp ? 0.5 * sum : rule(edge, sum));
            added[edge] = v;
            if (isSharp) {
                sharp.insert(std::minmax(edge.first, v));
                sharp.insert(std::minmax(edge.second, v));
            }
        }
        sharp_ = sharp;
        return added;
    }

    void subdivideQuads() {
        std::vector<Vec3d> faceMiddles;
        for (const Face& face : faces_) {
            Vec3d sum(0.0);
            for (const std::uint32_t v : face.corners) {
                sum += positions_[v];
            }
            faceMiddles.push_back(sum / static_cast<double>(face.corners.size()));
        }
        std::vector<Vec3d> positions(positions_.size());
        for (std::uint32_t v = 0; v < positions_.size(); ++v) {
            const auto n = static_cast<double>(neighbours_.at(v).size());
            Vec3d ring(0.0);
            Vec3d around(0.0);
            for (const std::uint32_t other : neighbours_.at(v)) {
                ring += 0.5 * (positions_[other] + positions_[v]) / n;
            }
            for (const std::uint32_t f : facesAt_.at(v)) {
                around += faceMiddles[f] / static_cast<double>(facesAt_.at(v).size());
            }
            positions[v] = moveSharp(v).value_or((around + 2.0 * ring + (n - 3.0) * positions_[v]) / n);
        }
        const auto edges = addEdgeVertices(positions, [&](const Edge& edge, const Vec3d& sum) {
            const std::vector<std::uint32_t>& on = facesOn_.at(edge);
            return 0.25 * (sum + faceMiddles[on[0]] + faceMiddles[on[1]]);
        });
        std::vector<Face> faces;
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const Face& face = faces_[f];
            const std::size_t n = face.corners.size();
            const auto middle = static_cast<std::uint32_t>(positions.size());
            positions.push_back(faceMiddles[f]);
            for (std::size_t k = 0; k < n; ++k) {
                const std::uint32_t v = face.corners[k];
                const std::uint32_t after = edges.at(std::minmax(v, face.corners[(k + 1) % n]));
                const std::uint32_t before = edges.at(std::minmax(v, face.corners[(k + n - 1) % n]));
                Face child{{v, after, middle, before}, face.patch, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
                if (face.uv.empty()) {
                    child.patch += static_cast<std::uint32_t>(k);
                } else {
                    const Vec2d here = face.uv[k];
                    const Vec2d next = face.uv[(k + 1) % 4];
                    const Vec2d last = face.uv[(k + 3) % 4];
                    child.uv = {here, .5 * (here + next), .5 * (next + last), .5 * (here + last)};
                }
                faces.push_back(child);
            }
        }
        positions_ = positions;
        faces_ = faces;
        connect();
    }

    void subdivideLoop() {
        std::vector<Vec3d> positions(positions_.size());
        for (std::uint32_t v = 0; v < positions_.size(); ++v) {
            const auto n = static_cast<double>(neighbours_.at(v).size());
            Vec3d ring(0.0);
            for (const std::uint32_t other : neighbours_.at(v)) {
                ring += positions_[other];
            }
            const double weight = loopWeight(n);
            positions[v] = moveSharp(v).value_or((1.0 - n * weight) * positions_[v] + weight * ring);
        }
        const auto edges = addEdgeVertices(positions, [&](const Edge& edge, const Vec3d& sum) {
            Vec3d opposite(0.0);
            for (const std::uint32_t f : facesOn_.at(edge)) {
                for (const std::uint32_t v : faces_[f].corners) {
                    opposite += v != edge.first && v != edge.second ? positions_[v] : Vec3d(0.0);
                }
            }
            return 0.375 * sum + 0.125 * opposite;
        });
        std::vector<Face> faces;
        for (const Face& face : faces_) {
            std::array<std::uint32_t, 3> m{};
            std::array<Vec2d, 3> t{};
            for (std::size_t k = 0; k < 3; ++k) {
                m[k] = edges.at(std::minmax(face.corners[k], face.corners[(k + 1) % 3]));
                t[k] = .5 * (face.uv[k] + face.uv[(k + 1) % 3]);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                faces.push_back({{face.corners[k], m[k], m[(k + 2) % 3]},
                                 face.patch,
                                 {face.uv[k], t[k], t[(k + 2) % 3]}});
            }
            faces.push_back({{m[0], m[1], m[2]}, face.patch, {t[0], t[1], t[2]}});
        }
        positions_ = positions;
        faces_ = faces;
        connect();
    }

    bool isLoop_;
    std::vector<Vec3d> positions_;
    std::vector<Face> faces_;
    std::set<Edge> sharp_;
    std::map<std::uint32_t, std::set<std::uint32_t>> neighbours_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> facesAt_;
    std::map<Edge, std::vector<std::uint32_t>> facesOn_;
};

}  // namespace fluxwalk::test
