#pragma once

#include <vector>

#include "core/base/bounds.h"
#include "core/base/random.h"
#include "core/rays/spatial_tree.h"

namespace fluxwalk::test {

/// Boxes up to `size` wide in [0, 10]^3.
inline std::vector<base::Box> randomBoxes(std::uint64_t key, std::size_t count, double size) {
    base::RandomStream random(key);
    std::vector<base::Box> boxes(count);
    for (base::Box& box : boxes) {
        const double x = random.next();
        const double y = random.next();
        box.lower = 10.0 * base::Vec3d(x, y, random.next());
        const double w = random.next();
        const double h = random.next();
        box.upper = box.lower + size * base::Vec3d(w, h, random.next());
    }
    return boxes;
}

/// Boxes that a random line through the root's box meets in the mean: areas of all nodes over the root's.
inline double surfaceCost(const rays::SpatialTree& tree) {
    const auto area = [](const rays::SpatialTree::Node& node) {
        const base::Vec3d d = base::Vec3d(node.upper) - base::Vec3d(node.lower);
        return d.x * d.y + d.y * d.z + d.z * d.x;
    };
    double sum = 0.0;
    for (const rays::SpatialTree::Node& node : tree.nodes()) {
        sum += area(node);
    }
    return tree.isEmpty() ? 0.0 : sum / area(tree.nodes()[0]);
}

}  // namespace fluxwalk::test
