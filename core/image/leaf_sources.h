#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "core/image/source_points.h"
#include "core/image/tangent_fit.h"
#include "core/solve/state.h"
#include "core/transport/cluster_points.h"

/// What lights an element, found once for all pixels that see it: the links of the element and of all that it
/// is part of name the sources (ALGORITHMS 1.14).
namespace fluxwalk::image {

class PartLight;

/// One source: an element or a part of one, a cluster, light or the sky.
struct Source {
    NodeId node = NodeId::none;
    Rgb radiosity{0.0f};      ///< lm/m2
    float brightness = 0.0f;  ///< mean of its channels
    /// Largest unoccluded irradiance, mean of the channels, at the points of the element, lux.
    float most = 0.0f;
    /// Of its unoccluded irradiance the part that the solve saw arrive at the element.
    float visibility = 1.0f;
    /// What kernels see of an element or its part; nullptr of a cluster.
    const transport::ElementPoints* points = nullptr;
    /// Of a part; nullptr of a whole.
    const surface::Region* region = nullptr;
    /// A cluster's form factor over the receiving element; of an element that is partly hidden, the part of
    /// its kernel that its exposed cells have.
    Terms smooth{};
    /// That part is to be found anew at every point, since the element is near.
    bool isHiddenNear = false;
    bool isPartlyHidden = false;
};

/// Point of a source for two numbers in [0, 1): uniform where areas are. `measure` is its area in m2 for all
/// such pairs together. Of clusters also the patch, as an index into Hierarchy::patches().
transport::ClusterSampler::Place samplePoint(const hierarchy::Hierarchy& hierarchy, const Source& source,
                                             const base::Vec2d& random);

struct LeafSources {
    NodeId leaf = NodeId::none;
    TangentFit fit;
    /// Sources that surely nothing hides.
    std::vector<Source> open;
    /// Sources with shadow rays of their own: those that bring most.
    std::vector<Source> strong;
    /// All others, in the order of their direction, so that neighbours share what hides them.
    std::vector<Source> weak;
    /// Lights without area and the sky.
    std::vector<NodeId> lights;
};

/// Light of sources that are so near that a pixel sees how it changes within them: gathered there in turn, or
/// as the solve has it.
enum class NearLight { gathered, solved };

/// Makes them, and keeps what several elements ask for. Not for several threads at once.
class SourceFinder {
  public:
    /// Keeps references to both.
    SourceFinder(const solve::Problem& problem, SourcePoints& points,
                 NearLight nearLight = NearLight::gathered);
    SourceFinder(SourceFinder&&) noexcept;
    ~SourceFinder();

    LeafSources find(NodeId leaf);

  private:
    struct Search;
    void add(Search& search, NodeId source, bool isOpen, float visibility);
    void addCluster(Search& search, NodeId source, bool isOpen, float visibility);
    void addElement(Search& search, NodeId source, bool isOpen, float visibility);
    void addHidden(Search& search, NodeId source, double distance);
    void addParts(Search& search, const Source& whole, transport::Path part, const CellLight* light,
                  bool isOpen);
    bool isSeenWithin(const Search& search, NodeId leaf, const transport::ElementPoints& points,
                      transport::Path part) const;
    bool isLitWithin(const Search& search, const Source& source, const transport::ElementPoints& points,
                     const base::Lanes& factors) const;
    const transport::ClusterPoints& clusterPoints(NodeId cluster);

    const solve::Problem& problem_;
    const hierarchy::Hierarchy& h_;
    SourcePoints& points_;
    /// In closed scenes also those that send nothing: all that a point sees is known.
    bool keepsDark_;
    std::unique_ptr<PartLight> partLight_;
    std::unordered_map<NodeId, std::unique_ptr<transport::ClusterPoints>> clusterPoints_;
};

/// Part of a source's kernel at a point that comes from its exposed cells.
double exposedShareAt(const hierarchy::Hierarchy& hierarchy, NodeId source, const Vec3d& x, const Vec3d& n);

}  // namespace fluxwalk::image
