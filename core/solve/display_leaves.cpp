#include "core/solve/display_leaves.h"

namespace fluxwalk::solve {

display::Leaf displayLeaf(const hierarchy::Hierarchy& h, base::NodeId leaf) {
    const hierarchy::ElementName name = h.name(leaf);
    const hierarchy::Shape& shape = h.shape(leaf);
    // What lies in a narrow gap is known to be dark; of what lies in a solid nothing is known.
    const bool isDark = shape.isCovered && shape.exposedCells == 0;
    return {name.patch, name.back, name.path, h.light(leaf).irradiance, isDark ? 1.0f : shape.exposed};
}

}  // namespace fluxwalk::solve
