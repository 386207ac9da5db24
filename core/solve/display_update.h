#pragma once

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

    /// Where the cells of these meshes are; until the next refresh().
    std::vector<const display::CellTable*> tables() const;

    /// Displayed irradiance at probes; refreshes first.
    std::vector<Rgb> valuesAt(const std::vector<Probe>& probes);

    /// What the meshes take, with what making, drawing or writing them does, in bytes.
    std::uint64_t bytes() const;
    /// Number of the hierarchy's nodes when they were made; 0 before.
    std::size_t shownNodes() const { return shownNodes_; }

  private:
    /// Rebuilds what changed; curved surfaces with the given curvatureAngle (radians).
    void rebuild(double curvatureAngle);

    Problem& problem_;
    std::vector<std::uint8_t> isCurved_;          ///< by object
    std::vector<std::vector<NodeId>> patchesOf_;  ///< by object
    std::vector<std::unique_ptr<display::PatchTopology>> topologies_;
    std::vector<display::DisplayMeshes> meshes_;
    std::size_t shownNodes_ = 0;
    std::uint64_t refreshed_ =
        0;  ///< bytes of the meshes when they were refreshed last, rounder than for probes
    std::vector<std::uint64_t> digests_;  ///< of each object's leaves and values
};

}  // namespace fluxwalk::solve
