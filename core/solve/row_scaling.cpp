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

}  // namespace fluxwalk::solve
