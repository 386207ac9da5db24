#pragma once

#include <chrono>

#include "core/display/display_mesh.h"
#include "core/solve/probes.h"

namespace fluxwalk::solve {

/// The displayed form of a solution: rebuilds the meshes of the objects whose leaves or values changed and
/// shares the others.
class DisplayUpdate {
  public:
    explicit DisplayUpdate(Problem& problem);

    /// Meshes of the present solution, in the order of the objects.
    scene::LitMeshes refresh();

    /// The same as far as there is time, the smallest objects first; the others stay as they were shown last.
    /// Whether none is left. At a first time all must be made.
    bool refreshUntil(std::chrono::steady_clock::time_point until);
    /// As they were made last.
    scene::LitMeshes meshes() const;

    /// Where the cells of these meshes are; until the next refresh().
    std::vector<const display::CellTable*> tables() const;

    /// Displayed irradiance at probes; refreshes first.
    std::vector<Rgb> valuesAt(const std::vector<Probe>& probes);

    /// What the meshes take, with what making, drawing or writing them does, in bytes.
    std::uint64_t bytes() const;
    /// Number of the hierarchy's nodes when they were made; 0 before.
    std::size_t shownNodes() const { return shownNodes_; }

  private:
    /// An object's meshes and what they were made of.
    struct Shown {
        display::DisplayMeshes meshes;
        std::uint64_t shape = 0;   ///< digest of the leaves without their light
        std::uint64_t digest = 0;  ///< of both
    };

    using Clock = std::chrono::steady_clock;
    /// Of one thread.
    struct Workspace {
        std::vector<display::Leaf> leaves;
        display::MeshWorkspace meshes;
    };

    /// Rebuilds what changed, as long as there is time; curved surfaces with the given curvatureAngle
    /// (radians). Whether all is done.
    bool rebuild(double curvatureAngle, std::vector<Shown>& all, Clock::time_point until);
    void rebuildObject(std::size_t o, const display::MeshOptions& options, Workspace& work, Shown& shown);
    /// Where what probes read of an object is.
    std::vector<Shown>& probedOf(std::size_t object) { return isCurved_[object] != 0 ? probed_ : shown_; }

    Problem& problem_;
    std::vector<std::uint8_t> isCurved_;          ///< by object
    std::vector<std::vector<NodeId>> patchesOf_;  ///< by object
    std::vector<std::unique_ptr<display::PatchTopology>> topologies_;
    std::vector<Shown> shown_;
    std::vector<Shown> probed_;  ///< of curved objects, not cut further for the eye
    std::size_t shownNodes_ = 0;
};

}  // namespace fluxwalk::solve
