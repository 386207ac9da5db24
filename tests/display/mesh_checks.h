#pragma once

#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "core/scene/lit_mesh.h"

/// What a crack-free mesh must fulfil, by bitwise positions.
namespace fluxwalk::display {

using PositionKey = std::tuple<float, float, float>;

inline PositionKey keyOf(const base::Vec3& p) {
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

struct EdgeReport {
    std::size_t vertices = 0;  ///< different positions
    std::size_t edges = 0;     ///< undirected
    std::size_t triangles = 0;
    std::size_t overused = 0;    ///< edges that run twice in one direction
    std::size_t degenerate = 0;  ///< edges from a position to itself
    /// Ends of edges without a partner in the other direction.
    std::vector<std::pair<base::Vec3, base::Vec3>> open;

    long eulerCharacteristic() const {
        return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(triangles);
    }
};

inline EdgeReport checkEdges(const scene::LitMesh& mesh) {
    EdgeReport report;
    std::set<PositionKey> positions;
    std::map<std::pair<PositionKey, PositionKey>, int> directed;
    report.triangles = mesh.triangles.size() / 3;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const PositionKey a = keyOf(mesh.positions[mesh.triangles[t + k]]);
            const PositionKey b = keyOf(mesh.positions[mesh.triangles[t + (k + 1) % 3]]);
            positions.insert(a);
            report.degenerate += a == b ? 1u : 0u;
            report.overused += ++directed[{a, b}] > 1 ? 1u : 0u;
        }
    }
    report.vertices = positions.size();
    for (const auto& [edge, count] : directed) {
        const auto& [a, b] = edge;
        const bool isPaired = directed.contains({b, a});
        if (!isPaired) {
            report.open.push_back({base::Vec3(std::get<0>(a), std::get<1>(a), std::get<2>(a)),
                                   base::Vec3(std::get<0>(b), std::get<1>(b), std::get<2>(b))});
        }
        report.edges += !isPaired || a < b ? 1u : 0u;
    }
    return report;
}

inline base::Vec3d areaVector(const scene::LitMesh& mesh, std::size_t triangle) {
    const auto at = [&](std::size_t k) {
        return base::Vec3d(mesh.positions[mesh.triangles[3 * triangle + k]]);
    };
    return 0.5 * glm::cross(at(1) - at(0), at(2) - at(0));
}

inline double totalArea(const scene::LitMesh& mesh) {
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
        sum += glm::length(areaVector(mesh, t));
    }
    return sum;
}

}  // namespace fluxwalk::display
