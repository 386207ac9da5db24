#include "core/solve/elements.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "core/solve/solver.h"
#include "core/solve/sweep.h"

namespace fluxwalk::solve {

namespace {

/// Edges between triangles of different elements and at the mesh's border.
std::vector<std::uint32_t> findEdges(const scene::LitMesh& mesh,
                                     const std::vector<std::uint32_t>& elementOf) {
    struct Edge {
        std::array<std::uint32_t, 2> ends;
        std::uint32_t element;
    };
    std::vector<Edge> all;
    all.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < elementOf.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[3 * t + k];
            const std::uint32_t b = mesh.triangles[3 * t + (k + 1) % 3];
            all.push_back({{std::min(a, b), std::max(a, b)}, elementOf[t]});
        }
    }
    std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
    std::vector<std::uint32_t> edges;
    for (std::size_t begin = 0; begin < all.size();) {
        std::size_t end = begin;
        bool isWithin = true;
        while (end < all.size() && all[end].ends == all[begin].ends) {
            isWithin = isWithin && all[end++].element == all[begin].element;
        }
        if (!isWithin || end - begin == 1) {
            edges.insert(edges.end(), all[begin].ends.begin(), all[begin].ends.end());
        }
        begin = end;
    }
    return edges;
}

}  // namespace

MeshElements describeElements(const Problem& problem, const scene::LitMesh& mesh,
                              const display::CellTable& table, const std::vector<float>& residuals,
                              const std::vector<float>& errors) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    MeshElements result;
    result.elementOf.resize(mesh.triangles.size() / 3);
    NodeId present = NodeId::none;
    for (std::uint32_t patch = 0; patch + 1 < table.firstCell.size(); ++patch) {
        for (std::uint32_t cell = table.firstCell[patch]; cell < table.firstCell[patch + 1]; ++cell) {
            // Cells are what the display made of leaves: those themselves or parts of them, in their order.
            const surface::Path path = table.places[cell].path;
            NodeId leaf = h.patchNode(mesh.object, patch, mesh.back);
            unsigned level = 0;
            while (!h.isLeaf(leaf)) {
                FLUXWALK_CHECK_LT(level, surface::pathLevel(path));
                leaf = h.child(leaf, surface::pathStep(path, level++));
            }
            if (leaf != present) {
                present = leaf;
                result.level.push_back(static_cast<std::uint8_t>(level));
                if (!residuals.empty()) {
                    result.residual.push_back(residuals[base::index(leaf)]);
                }
                if (!errors.empty()) {
                    result.error.push_back(errors[base::index(leaf)]);
                }
            }
            const auto element = static_cast<std::uint32_t>(result.level.size() - 1);
            for (std::uint32_t t = table.firstTriangle[cell]; t < table.firstTriangle[cell + 1]; ++t) {
                result.elementOf[t] = element;
            }
        }
    }
    result.edges = findEdges(mesh, result.elementOf);
    return result;
}

void showOn(Snapshot& snapshot, scene::LitMeshes meshes, const Problem& problem,
            const std::vector<const display::CellTable*>& tables) {
    FLUXWALK_CHECK_EQ(meshes.size(), tables.size());
    snapshot.meshes = std::move(meshes);
    if (snapshot.elements.empty()) {
        return;
    }
    snapshot.elements.resize(tables.size());
    problem.executor.forRange(tables.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            snapshot.elements[i] = std::make_shared<const MeshElements>(
                describeElements(problem, *snapshot.meshes[i], *tables[i], {}));
        }
    });
}

std::vector<float> computeResiduals(Problem& problem) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<hierarchy::Light> before;
    before.reserve(h.nodeCount());
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        before.push_back(h.light(NodeId{i}));
    }
    const Counters counters = problem.statistics.counters;
    const StageTimes times = problem.statistics.times;
    Sweeper(problem).sweep();
    std::vector<float> residuals(h.nodeCount(), 0.0f);
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) == hierarchy::NodeKind::element && h.isLeaf(id)) {
            residuals[i] = base::channelMean(glm::abs(h.light(id).radiosity - before[i].radiosity));
        }
        h.light(id) = before[i];
    }
    problem.statistics.counters = counters;
    problem.statistics.times = times;
    return residuals;
}

std::vector<ClusterBox> listClusters(const Problem& problem) {
    const hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<ClusterBox> boxes;
    std::vector<std::pair<NodeId, std::uint32_t>> stack;
    if (h.root() != NodeId::none) {
        stack.emplace_back(h.root(), 0);
    }
    while (!stack.empty()) {
        const auto [id, depth] = stack.back();
        stack.pop_back();
        if (h.kind(id) != hierarchy::NodeKind::cluster) {
            continue;
        }
        if (!h.patchesBelow(id).empty()) {
            const hierarchy::Extent& extent = h.extent(id);
            boxes.push_back({extent.lower, extent.upper, depth});
        }
        stack.emplace_back(h.child(id, 1), depth + 1);
        stack.emplace_back(h.child(id, 0), depth + 1);
    }
    return boxes;
}

}  // namespace fluxwalk::solve
