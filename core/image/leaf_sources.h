#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <unordered_map>
#include <vector>

#include "core/solve/state.h"
#include "core/transport/cluster_points.h"
#include "core/transport/element_points.h"

/// What lights an element, found once for all pixels that see it: the links of the element and of all that it
/// is part of name the sources (ALGORITHMS 1.14).
namespace fluxwalk::image {

using base::NodeId;
using base::Rgb;
using base::Vec3d;

/// Terms of a quadratic function of two coordinates: 1, a, b, a a, a b, b b.
inline constexpr std::size_t kTerms = 6;
using Terms = std::array<float, kTerms>;

/// Coordinates in an element's tangent plane, 0 in its middle, about 1 at its ends, and the quadratic
/// functions of them that fit values at the element's eight points best.
class TangentFit {
  public:
    TangentFit() = default;
    explicit TangentFit(const transport::ElementPoints& element);

    Terms termsAt(const Vec3d& position) const;
    /// Coefficients for values at the eight points.
    Terms fit(const base::Lanes& values) const;

  private:
    Vec3d middle_{};
    Vec3d along_{};   ///< unit tangent over the element's half length that way
    Vec3d across_{};  ///< likewise
    std::array<std::array<double, base::kLanes>, kTerms> solution_{};
};

/// Value of a fitted function.
inline float evaluate(const Terms& coefficients, const Terms& at) {
    float sum = 0.0f;
    for (std::size_t k = 0; k < kTerms; ++k) {
        sum += coefficients[k] * at[k];
    }
    return sum;
}

/// One source: an element, cluster, light or the sky.
struct Source {
    NodeId node = NodeId::none;
    Rgb radiosity{0.0f};      ///< lm/m2
    float brightness = 0.0f;  ///< mean of its channels
    /// Largest unoccluded irradiance, mean of the channels, at the points of the element, lux.
    float most = 0.0f;
    /// Of its unoccluded irradiance the part that the solve saw arrive at the element.
    float visibility = 1.0f;
    /// What kernels see of an element; nullptr of a cluster.
    const transport::ElementPoints* points = nullptr;
    /// A cluster's form factor over the receiving element; of an element that is partly hidden, the part of
    /// its kernel that its exposed cells have.
    Terms smooth{};
    /// That part is to be found anew at every point, since the element is near.
    bool isHiddenNear = false;
    bool isPartlyHidden = false;
};

/// Point of a source for two numbers in [0, 1): uniform where areas are. `measure` is its area in m2 for all
/// such pairs together. Of clusters also the patch, as an index into Hierarchy::patches().
transport::ClusterSampler::Place samplePoint(const hierarchy::Hierarchy& hierarchy, NodeId source,
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

/// What kernels see of the elements that light comes from: made when first asked for, 1 kB each, for any
/// number of threads.
class SourcePoints {
  public:
    explicit SourcePoints(const hierarchy::Hierarchy& hierarchy);
    ~SourcePoints();
    SourcePoints(const SourcePoints&) = delete;
    SourcePoints& operator=(const SourcePoints&) = delete;

    const transport::ElementPoints& of(NodeId element);

  private:
    const hierarchy::Hierarchy& hierarchy_;
    std::vector<std::atomic<const transport::ElementPoints*>> points_;
};

/// Makes them, and keeps what several elements ask for. Not for several threads at once.
class SourceFinder {
  public:
    /// Keeps references to both.
    SourceFinder(const solve::Problem& problem, SourcePoints& points)
        : problem_(problem), h_(problem.hierarchy), points_(points) {}

    LeafSources find(NodeId leaf);

  private:
    struct Search;
    void add(Search& search, NodeId source, bool isOpen, float visibility);
    void addCluster(Search& search, NodeId source, bool isOpen, float visibility);
    void addElement(Search& search, NodeId source, bool isOpen, float visibility);
    const transport::ClusterPoints& clusterPoints(NodeId cluster);

    const solve::Problem& problem_;
    const hierarchy::Hierarchy& h_;
    SourcePoints& points_;
    std::unordered_map<NodeId, std::unique_ptr<transport::ClusterPoints>> clusterPoints_;
};

/// Form factors of an element's source at eight points, unoccluded, as if all of it were exposed.
base::Lanes computeFactors(const base::Lanes3& x, const base::Lanes3& normal,
                           const transport::ElementPoints& source);

/// Part of a source's kernel at a point that comes from its exposed cells.
double exposedShareAt(const hierarchy::Hierarchy& hierarchy, NodeId source, const Vec3d& x, const Vec3d& n);

}  // namespace fluxwalk::image
