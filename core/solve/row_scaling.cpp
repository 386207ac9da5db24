#include "core/solve/row_scaling.h"

#include <algorithm>
#include <cmath>

#include "core/solve/audit.h"

namespace fluxwalk::solve {

std::vector<float> computeRowScaling(const Problem& problem) {
    constexpr int kRounds = 6;
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const float most = std::sqrt(1.0f + kMaxRowScaling);
    const float least = std::sqrt(1.0f - kMaxRowScaling);
    const bool isClosed = !h.reached().isOpen;
    std::vector<float> scale(h.nodeCount(), 1.0f);
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<float> sums = computeRowSums(problem, scale);
        for (auto i = static_cast<std::uint32_t>(h.nodeCount()); i-- > 0;) {
            const NodeId id{i};
            if (h.kind(id) != hierarchy::NodeKind::element) {
                continue;
            }
            if (h.isLeaf(id)) {
                const float sum = isClosed ? sums[i] : std::max(1.0f, sums[i]);
                if (sum > 0.0f) {
                    scale[i] = std::clamp(scale[i] / std::sqrt(sum), least, most);
                }
                continue;
            }
            // An inner node's transfers serve all its leaves.
            double weighted = 0.0;
            double area = 0.0;
            for (unsigned c = 0; c < 4; ++c) {
                const auto part = static_cast<double>(h.shape(h.child(id, c)).areaInParent());
                weighted += part * static_cast<double>(scale[base::index(h.child(id, c))]);
                area += part;
            }
            scale[i] = area > 0.0 ? static_cast<float>(weighted / area) : 1.0f;
        }
    }
    return scale;
}

std::vector<float> limitRows(const Problem& problem) {
    // Sums that errors of factors alone make are left alone.
    constexpr float kTolerated = 1.05f;
    constexpr float kMostReflected = 0.98f;
    const hierarchy::Hierarchy& h = problem.hierarchy;
    const std::vector<float> sums = computeRowSums(problem, problem.rowScale);
    std::vector<float> kept;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Rgb& reflectance = h.light(NodeId{static_cast<std::uint32_t>(i)}).reflectance;
        const float largest = std::max({reflectance.r, reflectance.g, reflectance.b});
        if (sums[i] > kTolerated && largest * sums[i] > kMostReflected) {
            kept.resize(h.nodeCount(), 1.0f);
            kept[i] = std::max(kTolerated, kMostReflected / largest) / sums[i];
        }
    }
    return kept;
}

}  // namespace fluxwalk::solve
