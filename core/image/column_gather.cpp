#include "core/image/column_gather.h"

#include <algorithm>
#include <array>

namespace fluxwalk::image {

void ColumnGather::light(std::vector<Wanted>& wanted, std::uint32_t row) {
    std::stable_sort(wanted.begin(), wanted.end(),
                     [](const Wanted& a, const Wanted& b) { return a.seen->leaf < b.seen->leaf; });
    std::array<PixelPoint, PixelGather::kPoints> points;
    std::array<PixelLight, PixelGather::kPoints> light{};
    for (std::size_t first = 0; first < wanted.size();) {
        const NodeId leaf = wanted[first].seen->leaf;
        std::size_t count = 0;
        while (count < points.size() && first + count < wanted.size() &&
               wanted[first + count].seen->leaf == leaf) {
            points[count] = wanted[first + count].seen->point;
            ++count;
        }
        gather_.gather(sourcesOf(leaf, row), {points.data(), count}, {light.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            *wanted[first + i].light = light[i];
        }
        first += count;
        gathers_ += count;
    }
}

void ColumnGather::forget(std::uint32_t row) {
    std::erase_if(leaves_, [row](const auto& entry) { return entry.second.row + 2 < row; });
}

const LeafSources& ColumnGather::sourcesOf(NodeId leaf, std::uint32_t row) {
    auto found = leaves_.find(leaf);
    if (found == leaves_.end()) {
        found = leaves_.emplace(leaf, Kept{finder_.find(leaf), row}).first;
    }
    found->second.row = row;
    return found->second.sources;
}

}  // namespace fluxwalk::image
