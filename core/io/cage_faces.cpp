#include "core/io/cage_faces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/base/normal_cone.h"
#include "core/base/random.h"

namespace fluxwalk::io {

namespace {

using base::Vec3;
using base::Vec3d;
using surface::ControlCage;

/// Cosine of the angle up to which two triangles are one plane: files round positions to float.
constexpr double kPlanar = 0.9999;

/// Corner of a polygon: its vertex in the cage, and its texture coordinates.
struct Corner {
    std::uint32_t vertex = 0;
    std::array<base::Vec2, 2> texcoords{};
};
using Polygon = std::vector<Corner>;

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t key = 0;
        for (int i = 0; i < 3; ++i) {
            key = base::combine(key, std::bit_cast<std::uint32_t>(p[i]));
        }
        return static_cast<std::size_t>(key);
    }
};

/// Gives vertices at one place one number.
class Welder {
  public:
    explicit Welder(ControlCage& cage) : cage_(cage) {}

    std::uint32_t vertexAt(const Vec3& position) {
        // Minus zero becomes zero: both are one place.
        const Vec3 key = position + Vec3(0.0f);
        const auto next = static_cast<std::uint32_t>(cage_.positions.size());
        const auto [found, isNew] = vertices_.try_emplace(key, next);
        if (isNew) {
            cage_.positions.emplace_back(key);
        }
        return found->second;
    }

  private:
    ControlCage& cage_;
    std::unordered_map<Vec3, std::uint32_t, PositionHash> vertices_;
};

// Removes corners that fell together with the one before; false where no polygon is left.
bool removeRepeated(Polygon& polygon) {
    polygon.erase(std::unique(polygon.begin(), polygon.end(),
                              [](const Corner& a, const Corner& b) { return a.vertex == b.vertex; }),
                  polygon.end());
    while (polygon.size() > 1 && polygon.front().vertex == polygon.back().vertex) {
        polygon.pop_back();
    }
    return polygon.size() >= 3;
}

// Fans that start in one vertex of the file; mirrored nodes run the other way round.
std::vector<std::vector<std::uint32_t>> joinFans(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<std::vector<std::uint32_t>> fans;
    for (const auto& t : triangles) {
        if (!fans.empty() && fans.back()[0] == t[0]) {
            std::vector<std::uint32_t>& fan = fans.back();
            if (fan.back() == t[1]) {
                fan.push_back(t[2]);
                continue;
            }
            if (fan[1] == t[2]) {
                fan.insert(fan.begin() + 1, t[1]);
                continue;
            }
        }
        fans.push_back({t[0], t[1], t[2]});
    }
    return fans;
}

/// Joins triangles to planar, convex quads.
class QuadPairing {
  public:
    QuadPairing(const ControlCage& cage, std::vector<Polygon>& polygons)
        : cage_(cage), polygons_(polygons), isJoined_(polygons.size(), 0) {}

    void run() {
        for (std::size_t i = 0; i + 1 < polygons_.size(); ++i) {
            if (isFree(i) && isFree(i + 1)) {
                join(i, i + 1);
            }
        }
        pairRest();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < polygons_.size(); ++i) {
            if (isJoined_[i] == 0) {
                std::swap(polygons_[kept++], polygons_[i]);
            }
        }
        polygons_.resize(kept);
    }

  private:
    bool isFree(std::size_t i) const { return polygons_[i].size() == 3 && isJoined_[i] == 0; }
    const Vec3d& at(const Corner& corner) const { return cage_.positions[corner.vertex]; }

    Vec3d unitNormal(const Corner& a, const Corner& b, const Corner& c) const {
        const Vec3d n = glm::cross(at(b) - at(a), at(c) - at(a));
        const double length = glm::length(n);
        return length > 0.0 ? n / length : n;
    }

    // Makes triangle i a quad with j, if they have an edge in common and lie well for it.
    bool join(std::size_t i, std::size_t j) {
        const Polygon& a = polygons_[i];
        const Polygon& b = polygons_[j];
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t l = 0; l < 3; ++l) {
                // The common edge runs from a[k+1] to a[k+2], and back in b.
                const Corner& opposite = b[(l + 2) % 3];
                if (a[(k + 1) % 3].vertex != b[(l + 1) % 3].vertex || a[(k + 2) % 3].vertex != b[l].vertex ||
                    opposite.vertex == a[k].vertex) {
                    continue;
                }
                const Polygon quad{a[k], a[(k + 1) % 3], opposite, a[(k + 2) % 3]};
                const Vec3d normal = unitNormal(a[0], a[1], a[2]);
                for (std::size_t c = 0; c < 4; ++c) {
                    // Also what makes it convex: every corner turns the same way.
                    if (glm::dot(unitNormal(quad[c], quad[(c + 1) % 4], quad[(c + 2) % 4]), normal) <
                        kPlanar) {
                        return false;
                    }
                }
                polygons_[i] = quad;
                isJoined_[j] = 1;
                return true;
            }
        }
        return false;
    }

    // What the order of the file did not tell: longest common edges first, as diagonals are.
    void pairRest() {
        struct Pair {
            double length;
            std::size_t first;
            std::size_t second;
        };
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> waiting;
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < polygons_.size(); ++i) {
            if (!isFree(i)) {
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const Corner& a = polygons_[i][k];
                const Corner& b = polygons_[i][(k + 1) % 3];
                const auto [other, isNew] = waiting.try_emplace(std::minmax(a.vertex, b.vertex), i);
                if (!isNew) {
                    pairs.push_back({glm::distance(at(a), at(b)), other->second, i});
                }
            }
        }
        std::stable_sort(pairs.begin(), pairs.end(),
                         [](const Pair& a, const Pair& b) { return a.length > b.length; });
        for (const Pair& pair : pairs) {
            if (isFree(pair.first) && isFree(pair.second)) {
                join(pair.first, pair.second);
            }
        }
    }

    const ControlCage& cage_;
    std::vector<Polygon>& polygons_;
    std::vector<std::uint8_t> isJoined_;
};

// Vertices that lost all their faces go.
void dropUnused(ControlCage& cage) {
    constexpr std::uint32_t kUnused = 0xffffffffu;
    std::vector<std::uint32_t> renumbered(cage.positions.size(), kUnused);
    std::vector<Vec3d> positions;
    for (std::uint32_t& v : cage.corners) {
        if (renumbered[v] == kUnused) {
            renumbered[v] = static_cast<std::uint32_t>(positions.size());
            positions.push_back(cage.positions[v]);
        }
        v = renumbered[v];
    }
    cage.positions = std::move(positions);
}

}  // namespace

ControlCage assembleCage(const std::vector<CageTriangles>& parts, surface::SubdivisionScheme scheme) {
    ControlCage cage;
    cage.scheme = scheme;
    Welder welder(cage);
    std::vector<Polygon> all;
    std::array<bool, 2> hasTexcoords{};
    for (const CageTriangles& part : parts) {
        const auto cornerAt = [&](std::uint32_t i) {
            Corner corner{welder.vertexAt(part.soup.positions[i]), {}};
            for (std::size_t set = 0; set < 2; ++set) {
                if (!part.soup.texcoords[set].empty()) {
                    corner.texcoords[set] = part.soup.texcoords[set][i];
                    hasTexcoords[set] = true;
                }
            }
            return corner;
        };
        const bool joins = scheme == surface::SubdivisionScheme::catmullClark;
        std::vector<Polygon> polygons;
        const auto addPolygon = [&](const auto& indices) {
            Polygon polygon;
            for (const std::uint32_t i : indices) {
                polygon.push_back(cornerAt(i));
            }
            if (removeRepeated(polygon)) {
                polygons.push_back(std::move(polygon));
            }
        };
        if (joins && part.areFans) {
            for (const std::vector<std::uint32_t>& fan : joinFans(part.soup.triangles)) {
                addPolygon(fan);
            }
        } else {
            for (const auto& triangle : part.soup.triangles) {
                addPolygon(triangle);
            }
            if (joins) {
                QuadPairing(cage, polygons).run();
            }
        }
        std::move(polygons.begin(), polygons.end(), std::back_inserter(all));
    }
    for (const Polygon& polygon : all) {
        cage.faceSizes.push_back(static_cast<std::uint32_t>(polygon.size()));
        for (const Corner& corner : polygon) {
            cage.corners.push_back(corner.vertex);
            for (std::size_t set = 0; set < 2; ++set) {
                if (hasTexcoords[set]) {
                    cage.texcoords[set].push_back(corner.texcoords[set]);
                }
            }
        }
    }
    dropUnused(cage);
    return cage;
}

void sharpenEdges(ControlCage& cage, double degrees) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> normals;
    const double limit = degrees * base::kPi / 180.0;
    std::size_t first = 0;
    for (const std::uint32_t count : cage.faceSizes) {
        const std::uint32_t* corner = cage.corners.data() + first;
        Vec3d area(0.0);
        for (std::uint32_t k = 2; k < count; ++k) {
            area += glm::cross(cage.positions[corner[k - 1]] - cage.positions[corner[0]],
                               cage.positions[corner[k]] - cage.positions[corner[0]]);
        }
        const double length = glm::length(area);
        const Vec3d normal = length > 0.0 ? area / length : area;
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto edge = std::minmax(corner[k], corner[(k + 1) % count]);
            const auto [other, isNew] = normals.try_emplace(edge, normal);
            if (!isNew && base::NormalCone::angleBetween(other->second, normal) > limit) {
                cage.creases.push_back({edge.first, edge.second, surface::kInfinitelySharp});
            }
        }
        first += count;
    }
}

}  // namespace fluxwalk::io
