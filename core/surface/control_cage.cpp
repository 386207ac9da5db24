#include "core/surface/control_cage.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::surface {

namespace {

/// Corners of a face and faces at a vertex: OpenSubdiv counts to 511.
constexpr std::uint32_t kMaxValence = 256;

/// Edge of a face from one vertex to the next.
struct DirectedEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t face = 0;

    std::uint64_t undirected() const { return std::uint64_t{std::min(from, to)} << 32 | std::max(from, to); }
};

std::string nameEdge(const DirectedEdge& e) {
    return "the edge between vertices " + std::to_string(std::min(e.from, e.to)) + " and " +
           std::to_string(std::max(e.from, e.to));
}

std::optional<std::string> checkNumbers(const ControlCage& cage) {
    std::size_t total = 0;
    for (std::size_t f = 0; f < cage.faceSizes.size(); ++f) {
        if (cage.faceSizes[f] < 3) {
            return "face " + std::to_string(f) + " has fewer than three corners";
        }
        if (cage.scheme == SubdivisionScheme::loop && cage.faceSizes[f] != 3) {
            return "face " + std::to_string(f) + " is no triangle, as the scheme of Loop needs";
        }
        if (cage.faceSizes[f] > kMaxValence) {
            return "face " + std::to_string(f) + " has more than " + std::to_string(kMaxValence) + " corners";
        }
        total += cage.faceSizes[f];
    }
    if (cage.faceSizes.empty()) {
        return "it has no faces";
    }
    if (total != cage.corners.size()) {
        return "its faces have " + std::to_string(total) + " corners, but " +
               std::to_string(cage.corners.size()) + " are given";
    }
    for (const std::vector<base::Vec2>& set : cage.texcoords) {
        if (!set.empty() && set.size() != total) {
            return "it has " + std::to_string(set.size()) + " texture coordinates for " +
                   std::to_string(total) + " corners";
        }
    }
    for (std::size_t v = 0; v < cage.positions.size(); ++v) {
        const Vec3d& p = cage.positions[v];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            return "vertex " + std::to_string(v) + " is not finite";
        }
    }
    for (const std::uint32_t v : cage.corners) {
        if (v >= cage.positions.size()) {
            return "a face names vertex " + std::to_string(v) + " of " +
                   std::to_string(cage.positions.size());
        }
    }
    return std::nullopt;
}

std::optional<std::string> checkFace(const ControlCage& cage, std::size_t face, const std::uint32_t* corner,
                                     std::uint32_t count) {
    // Twice the vector area, compared with the size of the face.
    Vec3d area(0.0);
    double extent = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = i + 1; j < count; ++j) {
            if (corner[i] == corner[j]) {
                return "face " + std::to_string(face) + " uses vertex " + std::to_string(corner[i]) +
                       " twice";
            }
        }
        const Vec3d a = cage.positions[corner[i]] - cage.positions[corner[0]];
        const Vec3d b = cage.positions[corner[(i + 1) % count]] - cage.positions[corner[0]];
        area += glm::cross(a, b);
        extent = std::max(extent, glm::dot(a, a));
    }
    if (!(glm::length(area) > 1e-12 * extent)) {
        return "face " + std::to_string(face) + " has no area";
    }
    return std::nullopt;
}

std::optional<std::string> checkEdges(std::vector<DirectedEdge> edges) {
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return a.undirected() != b.undirected() ? a.undirected() < b.undirected() : a.face < b.face;
    });
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i].undirected() != edges[i + 1].undirected()) {
            continue;
        }
        if (i + 2 < edges.size() && edges[i + 2].undirected() == edges[i].undirected()) {
            return nameEdge(edges[i]) + " belongs to more than two faces";
        }
        if (edges[i].from == edges[i + 1].from) {
            return "faces " + std::to_string(edges[i].face) + " and " + std::to_string(edges[i + 1].face) +
                   " on the two sides of " + nameEdge(edges[i]) + " face opposite ways";
        }
    }
    return std::nullopt;
}

// Faces around a vertex form one fan if, going from each to the next across their common edges, all are met.
std::optional<std::string> checkVertices(const ControlCage& cage) {
    /// A corner of a face: the vertices before and after it.
    struct Corner {
        std::uint32_t vertex;
        std::uint32_t before;
        std::uint32_t after;
    };
    std::vector<Corner> all;
    all.reserve(cage.corners.size());
    std::size_t first = 0;
    for (const std::uint32_t count : cage.faceSizes) {
        for (std::size_t i = 0; i < count; ++i) {
            all.push_back({cage.corners[first + i], cage.corners[first + (i + count - 1) % count],
                           cage.corners[first + (i + 1) % count]});
        }
        first += count;
    }
    std::sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.after < b.after;
    });
    std::size_t begin = 0;
    for (std::uint32_t vertex = 0; vertex < cage.positions.size(); ++vertex) {
        std::size_t end = begin;
        while (end < all.size() && all[end].vertex == vertex) {
            ++end;
        }
        if (begin == end) {
            return "vertex " + std::to_string(vertex) + " belongs to no face";
        }
        if (end - begin > kMaxValence) {
            return "more than " + std::to_string(kMaxValence) + " faces meet at vertex " +
                   std::to_string(vertex);
        }
        const auto next = [&](std::uint32_t spoke) -> const Corner* {
            const auto at = std::lower_bound(
                all.begin() + static_cast<std::ptrdiff_t>(begin),
                all.begin() + static_cast<std::ptrdiff_t>(end), spoke,
                [](const Corner& corner, std::uint32_t after) { return corner.after < after; });
            return at != all.begin() + static_cast<std::ptrdiff_t>(end) && at->after == spoke ? &*at
                                                                                              : nullptr;
        };
        // Start where no other face follows, if the fan has ends.
        std::size_t starts = 0;
        const Corner* start = &all[begin];
        for (std::size_t i = begin; i < end; ++i) {
            const bool hasPrevious =
                std::any_of(all.begin() + static_cast<std::ptrdiff_t>(begin),
                            all.begin() + static_cast<std::ptrdiff_t>(end),
                            [&](const Corner& other) { return other.before == all[i].after; });
            if (!hasPrevious) {
                ++starts;
                start = &all[i];
            }
        }
        std::size_t met = 1;
        for (const Corner* at = next(start->before); at != nullptr && at != start; at = next(at->before)) {
            ++met;
        }
        if (starts > 1 || met != end - begin) {
            return "at vertex " + std::to_string(vertex) + " faces meet that share no edge there";
        }
        begin = end;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::string> findDefect(const ControlCage& cage) {
    if (auto defect = checkNumbers(cage)) {
        return defect;
    }
    std::vector<DirectedEdge> edges;
    edges.reserve(cage.corners.size());
    std::size_t first = 0;
    for (std::size_t face = 0; face < cage.faceSizes.size(); ++face) {
        const std::uint32_t count = cage.faceSizes[face];
        const std::uint32_t* corner = cage.corners.data() + first;
        if (auto defect = checkFace(cage, face, corner, count)) {
            return defect;
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            edges.push_back({corner[i], corner[(i + 1) % count], static_cast<std::uint32_t>(face)});
        }
        first += count;
    }
    if (auto defect = checkEdges(edges)) {
        return defect;
    }
    if (auto defect = checkVertices(cage)) {
        return defect;
    }
    std::vector<std::uint64_t> known;
    known.reserve(edges.size());
    for (const DirectedEdge& e : edges) {
        known.push_back(e.undirected());
    }
    std::sort(known.begin(), known.end());
    for (const Crease& crease : cage.creases) {
        const DirectedEdge e{crease.from, crease.to, 0};
        if (!std::binary_search(known.begin(), known.end(), e.undirected())) {
            return "a crease runs between vertices " + std::to_string(e.from) + " and " +
                   std::to_string(e.to) + ", where there is no edge";
        }
        if (!(crease.sharpness >= 0.0f)) {
            return "the sharpness of " + nameEdge(e) + " is not a number from 0 on";
        }
    }
    return std::nullopt;
}

ControlCage transformCage(ControlCage cage, const base::Mat4d& map) {
    for (Vec3d& p : cage.positions) {
        p = Vec3d(map * glm::dvec4(p, 1.0));
    }
    if (glm::determinant(glm::dmat3(map)) < 0.0) {
        std::ptrdiff_t first = 0;
        for (const std::uint32_t count : cage.faceSizes) {
            const auto reverse = [&](auto& values) {
                if (!values.empty()) {
                    // The first corner keeps its place.
                    std::reverse(values.begin() + first + 1, values.begin() + first + count);
                }
            };
            reverse(cage.corners);
            reverse(cage.texcoords[0]);
            reverse(cage.texcoords[1]);
            first += count;
        }
    }
    return cage;
}

}  // namespace fluxwalk::surface
