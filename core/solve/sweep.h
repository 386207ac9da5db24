#pragma once

#include <array>

#include "core/solve/cluster_exchange.h"

namespace fluxwalk::solve {

/// Gathers, pushes and pulls over the whole hierarchy, in place, block by block (blocked Gauss-Seidel: Jacobi
/// inside a block, which is a run of neighbouring patches fixed by the hierarchy). ALGORITHMS 1.5, 1.11.
class Sweeper {
  public:
    /// Lays out the blocks; make a new one after refinement.
    explicit Sweeper(Problem& problem);

    /// One sweep. Returns sum |dB| A / sum B A over the leaves, channel means.
    double sweep();

    std::size_t blockCount() const { return blocks_.size(); }

  private:
    struct Block {
        std::size_t begin = 0;  ///< range of order_
        std::size_t end = 0;
        std::size_t beginPatch = 0;  ///< range of Hierarchy::patches()
        std::size_t endPatch = 0;
    };

    void gather(const Block& block);
    void pushPull(const Block& block, double& change, double& power);
    void pull(NodeId id);
    std::array<double, 4> pullWeights(NodeId id) const;

    /// Irradiance over an element: mean + s * local.x + t * local.y (transport::localPointCoordinates, in the
    /// region's orientation).
    struct LinearIrradiance {
        Rgb mean{0.0f};
        Rgb s{0.0f};
        Rgb t{0.0f};
    };
    LinearIrradiance inheritedBy(NodeId parent, unsigned child, const LinearIrradiance& from) const;

    Problem& problem_;
    ClusterExchange clusters_;
    std::vector<float> kept_;        ///< limitRows()
    std::vector<Rgb> fromClusters_;  ///< by patch of the block at hand
    std::vector<LinearIrradiance>
        gathered_;               ///< by node: through its own links, then with that of all ancestors
    std::vector<NodeId> order_;  ///< nodes of the elements' trees, parents before children
    std::vector<Block> blocks_;
};

}  // namespace fluxwalk::solve
