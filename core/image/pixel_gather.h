#pragma once

#include <span>
#include <vector>

#include "core/image/leaf_sources.h"
#include "core/rays/ray.h"

/// Irradiance for pictures: the same sources and exact form factors as solve/point_gather.h, at a bounded
/// number of shadow rays for each point.
namespace fluxwalk::image {

/// A point of an element that a picture shows.
struct PixelPoint {
    Vec3d position{};
    Vec3d normal{};         ///< of the surface, unit, towards the side that is seen
    Vec3d shading{};        ///< the normal that a normal or height map makes of it
    std::uint64_t key = 0;  ///< of what is random about the point
    /// In [0, 1): where its rays to weak sources lie among those of its neighbours.
    double phase = 0.5;
};

/// Irradiance in lux in two parts, of which one has most of the noise.
struct PixelLight {
    Rgb steady{0.0f};
    /// What rays to weak sources find beside what the solve knows of their visibility; may be negative.
    /// Smooth over an element but for the shadows of small things, and noisy.
    Rgb correction{0.0f};
    float noise = 0.0f;  ///< standard error of its channel mean, lux

    Rgb sum() const { return glm::max(steady + correction, Rgb(0.0f)); }
};

/// Weight at which the correction of `b` may stand for that of `a`: 1 where they differ by less than their
/// noise.
float likeness(const PixelLight& a, const PixelLight& b);

struct GatherRays {
    /// Most shadow rays to a source that brings all the light, and to all weak sources together.
    unsigned strong = 128;
    unsigned weak = 96;
    unsigned sky = 128;
};

/// Gathers at points of one element. Not for several threads at once: it keeps its buffers.
class PixelGather {
  public:
    PixelGather(const solve::Problem& problem, const GatherRays& rays)
        : problem_(problem), budget_(rays), isClosed_(!problem.hierarchy.reached().isOpen) {}

    /// Most points at once: as many as kernels compute together.
    static constexpr std::size_t kPoints = base::kLanes;

    /// Irradiance in lux at up to kPoints points of the leaf of `sources`.
    void gather(const LeafSources& sources, std::span<const PixelPoint> points,
                std::span<PixelLight> irradiance);

    std::uint64_t rayCount() const { return rayCount_; }

  private:
    /// Shadow rays to one strong source: the first ones, and more where these do not agree.
    struct Bundle {
        std::size_t source = 0;
        double factor = 0.0;
        std::size_t first = 0;
        std::size_t used = 0;
        unsigned tried = 0;
        unsigned most = 0;
        double all = 0.0;
        double seen = 0.0;
    };

    void findFactors(const LeafSources& sources, std::span<const PixelPoint> points);
    PixelLight gatherOne(const LeafSources& sources, const PixelPoint& point, std::size_t index);
    void aimStrong(const LeafSources& sources, const PixelPoint& point, Bundle& bundle, unsigned count);
    double weighWeak(const LeafSources& sources, const base::Lanes* factors, int lane);
    void aimWeak(const LeafSources& sources, const PixelPoint& point, double share);
    void trace();
    void count(Bundle& bundle) const;
    PixelLight sumWeak(const LeafSources& sources, const base::Lanes* factors, int lane,
                       double missing) const;
    Vec3d addLights(const LeafSources& sources, const PixelPoint& point);
    Vec3d addSky(NodeId sky, const PixelPoint& point);

    const solve::Problem& problem_;
    GatherRays budget_;
    bool isClosed_;
    std::uint64_t rayCount_ = 0;
    /// Form factors of the sources at the points, unoccluded: the open ones, the strong and the weak.
    std::vector<base::Lanes> factors_;
    std::vector<Bundle> bundles_;
    std::vector<rays::Ray> rays_;
    std::vector<double> weights_;
    std::vector<std::uint8_t> blocked_;
    std::vector<float> weakWeights_;  ///< by which weak sources are chosen
    /// A ray to a weak source: what it would bring and its form factor, relative to the weights, and how
    /// likely the solve takes it to arrive.
    struct WeakRay {
        Rgb light{0.0f};
        float factor = 0.0f;
        float expected = 0.0f;
    };
    std::vector<WeakRay> weakRays_;
    std::size_t firstWeak_ = 0;
    float weakFloor_ = 0.0f;  ///< brightness that dark sources count for
    std::vector<std::uint8_t> weakBlocked_;
};

}  // namespace fluxwalk::image
