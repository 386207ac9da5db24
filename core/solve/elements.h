#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/vec.h"
#include "core/display/display_mesh.h"

/// What lies under the displayed triangles, for people who want to see why they are as they are.
namespace fluxwalk::solve {

struct Problem;
struct Snapshot;

/// What a snapshot shall tell beside the light.
struct Detail {
    bool elements = false;
    bool residuals = false;  ///< with the elements; costs a sweep
    bool clusters = false;
    bool errors = false;  ///< of their links, with the elements

    bool operator==(const Detail&) const = default;
};

/// The elements that one lit mesh shows.
struct MeshElements {
    std::vector<std::uint32_t> elementOf;  ///< by triangle: index into the arrays below
    std::vector<std::uint32_t> edges;      ///< borders of the elements, two vertices of the mesh each
    std::vector<std::uint8_t> level;       ///< by element: splits below its patch
    /// By element: what one more sweep would change of its radiosity, lm/m2, mean of the channels; empty
    /// unless asked for.
    std::vector<float> residual;
    /// By element: the error that its links leave, lux (link_errors.h); empty unless asked for.
    std::vector<float> error;
};

/// Box of a cluster and how far it is below the root.
struct ClusterBox {
    base::Vec3 lower{};
    base::Vec3 upper{};
    std::uint32_t depth = 0;
};

/// The elements of one side of an object, shown as `mesh` with the cells of `table`. `residuals` and `errors`
/// by node, or empty.
MeshElements describeElements(const Problem& problem, const scene::LitMesh& mesh,
                              const display::CellTable& table, const std::vector<float>& residuals,
                              const std::vector<float>& errors = {});

/// Puts other meshes of the same solution into a snapshot, with their elements where it tells of elements
/// (not of residuals and errors). `tables` say where the meshes' cells are.
void showOn(Snapshot& snapshot, scene::LitMeshes meshes, const Problem& problem,
            const std::vector<const display::CellTable*>& tables);

/// By node: what one more sweep would change of the radiosity of leaves, lm/m2; 0 for other nodes. Leaves the
/// problem as it was.
std::vector<float> computeResiduals(Problem& problem);

/// All clusters, from the root down.
std::vector<ClusterBox> listClusters(const Problem& problem);

}  // namespace fluxwalk::solve
