#include "core/hierarchy/closed_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace fluxwalk::hierarchy {

namespace {

using base::Vec3;
using base::Vec3d;

// For each position the index of the first one equal to it in order of place.
std::vector<std::uint32_t> weld(std::span<const Vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        const Vec3& a = positions[i];
        const Vec3& b = positions[j];
        return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
    });
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool isSame = k > 0 && positions[order[k]] == positions[order[k - 1]];
        welded[order[k]] = isSame ? welded[order[k - 1]] : order[k];
    }
    return welded;
}

std::uint32_t findTop(std::vector<std::uint32_t>& above, std::uint32_t i) {
    while (above[i] != i) {
        above[i] = above[above[i]];
        i = above[i];
    }
    return i;
}

}  // namespace

bool isClosedOutwards(const surface::Surface& surface) {
    const surface::TriangleView mesh = surface.triangles();
    if (mesh.triangles.empty()) {
        return false;
    }
    const std::vector<std::uint32_t> welded = weld(mesh.positions);
    std::vector<std::uint64_t> edges;
    std::vector<std::uint64_t> reversed;
    edges.reserve(3 * mesh.triangles.size());
    reversed.reserve(3 * mesh.triangles.size());
    std::vector<std::uint32_t> above(welded.size());
    std::iota(above.begin(), above.end(), 0u);
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t a = welded[triangle[k]];
            const std::uint64_t b = welded[triangle[(k + 1) % 3]];
            edges.push_back(a << 32 | b);
            reversed.push_back(b << 32 | a);
            above[findTop(above, static_cast<std::uint32_t>(a))] =
                findTop(above, static_cast<std::uint32_t>(b));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::sort(reversed.begin(), reversed.end());
    if (edges != reversed || std::adjacent_find(edges.begin(), edges.end()) != edges.end()) {
        return false;
    }
    // Volumes of the parts, from the mesh's own middle against rounding far from the origin.
    const Vec3d middle = surface.bounds().center();
    std::vector<double> volume(welded.size(), 0.0);
    for (const auto& t : mesh.triangles) {
        const Vec3d a = Vec3d(mesh.positions[t[0]]) - middle;
        const Vec3d b = Vec3d(mesh.positions[t[1]]) - middle;
        const Vec3d c = Vec3d(mesh.positions[t[2]]) - middle;
        volume[findTop(above, welded[t[0]])] += glm::dot(a, glm::cross(b, c));
    }
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const auto& t) { return volume[findTop(above, welded[t[0]])] > 0.0; });
}

}  // namespace fluxwalk::hierarchy
