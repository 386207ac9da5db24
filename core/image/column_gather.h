#pragma once

#include <unordered_map>
#include <vector>

#include "core/image/sight.h"

namespace fluxwalk::image {

/// A point whose light is to be gathered.
struct Wanted {
    const Seen* seen = nullptr;
    PixelLight* light = nullptr;
};

/// Gathers for the tiles of one column of a picture, from top to bottom, with the sources that they have in
/// common. Not for several threads at once.
class ColumnGather {
  public:
    ColumnGather(const solve::Problem& problem, SourcePoints& points, const GatherRays& rays)
        : finder_(problem, points), gather_(problem, rays) {}

    /// Light of points in one row of tiles; changes their order.
    void light(std::vector<Wanted>& wanted, std::uint32_t row);
    /// Forgets what the rows before did not need.
    void forget(std::uint32_t row);

    std::uint64_t rays() const { return gather_.rayCount(); }
    std::uint64_t gathers() const { return gathers_; }

  private:
    struct Kept {
        LeafSources sources;
        std::uint32_t row = 0;
    };

    const LeafSources& sourcesOf(NodeId leaf, std::uint32_t row);

    SourceFinder finder_;
    PixelGather gather_;
    std::unordered_map<NodeId, Kept> leaves_;
    std::uint64_t gathers_ = 0;
};

}  // namespace fluxwalk::image
