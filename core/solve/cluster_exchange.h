#pragma once

#include "core/solve/state.h"
#include "core/transport/cluster_factor.h"

namespace fluxwalk::solve {

/// Light that comes and goes through the links of clusters, in two traversals (Schaefer, section 3): what the
/// source's patches send towards the other end is added up, what arrives is shared among the receiver's
/// patches, each by its own direction and distance (transport/cluster_factor.h). Isotropic clusters show the
/// mean of their patches and share evenly.
class ClusterExchange {
  public:
    /// Reads the links as they stand: make a new one after refinement. `scale`: a factor of each node on all
    /// its transfers, or empty. `isUniform`: every node has radiosity 1 instead of its own.
    ClusterExchange(const Problem& problem, const std::vector<float>& scale, bool isUniform = false);

    /// Radiosity that end `id` of a link shows to its other end, lm/m2: of clusters the mean by their
    /// patches' shares, of elements the mean by the link's linear kernel.
    Rgb shownBy(std::size_t link, NodeId id) const;

    /// Irradiance in lux that the links of all clusters above patches[begin, end) bring to them: out[i] is
    /// for patches[begin + i].
    void gather(std::size_t begin, std::size_t end, std::span<Rgb> out);

    /// Takes over the radiosities of patches[begin, end), which shownBy() reads.
    void refresh(std::size_t begin, std::size_t end);

    bool isEmpty() const { return problem_.links.clusterLinks == 0; }

  private:
    /// What one link brings to a cluster: the irradiance of a patch is `flux` times its share.
    struct Incoming {
        transport::Ball source;
        bool isEven = false;  ///< all patches get the same
        Rgb flux{0.0f};
        Rgb most{0.0f};  ///< what the source would send into a whole hemisphere, lux
    };

    /// How a cluster at one end of a link sees the other end.
    struct View {
        transport::Ball other;
        float shares = 0.0f;  ///< sum over its patches, m2 / m2
    };

    void refreshMeans(NodeId id, std::size_t begin, std::size_t end);
    void share(std::size_t begin, std::size_t end, std::span<Rgb> out) const;
    const View& viewFrom(std::size_t link, NodeId id) const;
    Incoming bring(NodeId cluster, std::size_t link) const;
    float scaleOf(NodeId id) const { return scale_.empty() ? 1.0f : scale_[base::index(id)]; }

    const Problem& problem_;
    const std::vector<float>& scale_;
    bool isUniform_;
    std::vector<std::array<View, 2>> views_;  ///< of both ends of the links with clusters; of elements unused
    std::array<std::vector<float>, 3> radiosity_;  ///< of the patches, scaled
    std::vector<Rgb> means_;                       ///< by node, of isotropic clusters: that of their patches
    std::vector<std::uint32_t> stamp_;             ///< by cluster: the last call of gather() that needed it
    std::vector<std::uint32_t> first_;             ///< by cluster: its first one in incoming_
    std::vector<Incoming> incoming_;
    std::vector<std::pair<NodeId, std::uint32_t>> wanted_;  ///< cluster and link of each incoming one
    std::uint32_t calls_ = 0;
};

}  // namespace fluxwalk::solve
