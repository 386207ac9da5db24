#pragma once

#include <memory>
#include <span>

#include "core/rays/cell_lists.h"
#include "core/rays/occluder.h"
#include "core/rays/patch_tree.h"
#include "core/rays/ray.h"

namespace fluxwalk::rays {

/// Occlusion through the tree over the patches: triangles of meshes in double precision and without gaps
/// between neighbours, other surfaces by Surface::intersect. Grids of the tree are walked cell by cell.
class TreeRays {
  public:
    /// Keeps references to the occluders.
    TreeRays(std::shared_ptr<const PatchTree> patches, const Occluders& occluders,
             const base::Executor& executor);

    /// The ray must be finite, with 0 <= tNear <= tFar (RayScene's guard).
    bool isOccluded(const Ray& ray) const;

    const std::shared_ptr<const PatchTree>& patches() const { return patches_; }

  private:
    struct Query;
    /// Corners of a triangle.
    struct Triangle {
        base::Vec3 a, b, c;
    };
    /// Triangles of an item; none where the object meets rays itself or not at all.
    struct Part {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };

    void collectTriangles();
    bool isMet(std::uint32_t item, Query& query) const;

    std::shared_ptr<const PatchTree> patches_;
    const Occluders* occluders_;
    std::vector<Triangle> triangles_;  ///< in order of the leaves
    std::vector<Part> parts_;          ///< by item
    CellLists cells_;
    /// Grid of each node or SpatialTree::kNone; empty where the tree has no grids.
    std::vector<std::uint32_t> gridOfNode_;
};

}  // namespace fluxwalk::rays
