#pragma once

#include "core/display/leaf_light.h"
#include "core/image/pixel_gather.h"

/// Light all over a leaf for display: gathered at its corners and middle, and at those of its quarters where
/// light changes between them more than triangles can show.
namespace fluxwalk::image {

struct Sharpness {
    /// A cell is cut where its middle differs from what its corners say by more than this part of its light.
    float bend = 0.04f;
    /// A leaf also where its corners differ among each other by more: a shadow's edge may pass between.
    float range = 0.3f;
    /// Darker places are judged as if they had this part of the scene's mean irradiance.
    float dark = 0.1f;
    /// No side is cut that is not longer (metres): 0 for a 512th of the scene's extent, 2 cm at most.
    double leastSide = 0.0;
    /// Most cuts of a leaf on top of each other.
    unsigned mostLevels = 5;
};

/// Not for several threads at once.
class LeafGather {
  public:
    /// Keeps references to the problem and to `points`.
    LeafGather(const solve::Problem& problem, SourcePoints& points, const GatherRays& rays,
               const Sharpness& sharpness);

    /// A function of the solution and the leaf alone. `topology` is that of the leaf's object.
    display::LeafLight gather(const display::PatchTopology& topology, NodeId leaf);

    std::uint64_t pointCount() const { return pointCount_; }
    std::uint64_t rayCount() const { return gather_.rayCount(); }

  private:
    class Work;

    const solve::Problem& problem_;
    Sharpness sharpness_;
    float noise_;  ///< differences of light that count as noise, as a part of it
    SourceFinder finder_;
    PixelGather gather_;
    std::uint64_t pointCount_ = 0;
};

}  // namespace fluxwalk::image
