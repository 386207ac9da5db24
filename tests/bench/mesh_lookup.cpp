#include "tests/bench/mesh_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/rays/tree_builder.h"

namespace fluxwalk::bench {

namespace {

struct Corners {
    std::array<std::uint32_t, 3> index;
    std::array<Vec3d, 3> position;
};

Corners cornersOf(const scene::LitMesh& mesh, std::uint32_t triangle) {
    Corners c{};
    for (std::size_t i = 0; i < 3; ++i) {
        c.index[i] = mesh.triangles[3 * triangle + i];
        c.position[i] = Vec3d(mesh.positions[c.index[i]]);
    }
    return c;
}

bool holds(const rays::SpatialTree::Node& node, const Vec3d& p, double tolerance) {
    for (int k = 0; k < 3; ++k) {
        if (p[k] < static_cast<double>(node.lower[k]) - tolerance ||
            p[k] > static_cast<double>(node.upper[k]) + tolerance) {
            return false;
        }
    }
    return true;
}

rays::SpatialTree makeTree(const scene::LitMesh& mesh, const base::Executor& executor) {
    std::vector<base::Box> boxes(mesh.triangles.size() / 3);
    for (std::uint32_t t = 0; t < boxes.size(); ++t) {
        for (const Vec3d& p : cornersOf(mesh, t).position) {
            boxes[t].extend(p);
        }
    }
    return rays::buildTree(rays::TreeBuilder::sah, {boxes}, executor);
}

}  // namespace

MeshLookup::MeshLookup(const scene::LitMesh& mesh, double tolerance, const base::Executor& executor)
    : mesh_(mesh), tolerance_(tolerance), tree_(makeTree(mesh, executor)) {}

std::optional<Rgb> MeshLookup::irradiance(const Vec3d& position, const Vec3d& normal) const {
    // On an edge rounding can put the point outside of both neighbours: the one that it leaves least is
    // taken.
    double leastOutside = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<Rgb> found;
    std::vector<std::uint32_t> stack;
    if (!tree_.isEmpty()) {
        stack.push_back(0);
    }
    while (!stack.empty()) {
        const std::uint32_t at = stack.back();
        stack.pop_back();
        const rays::SpatialTree::Node& node = tree_.nodes()[at];
        if (!holds(node, position, tolerance_)) {
            continue;
        }
        if (!node.isLeaf()) {
            stack.push_back(node.right);
            stack.push_back(at + 1);
            continue;
        }
        const Corners c = cornersOf(mesh_, node.item);
        std::array<double, 3> weight{};
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            weight[i] = glm::dot(
                normal, glm::cross(c.position[(i + 1) % 3] - position, c.position[(i + 2) % 3] - position));
            sum += weight[i];
        }
        if (!(sum > 0.0)) {
            continue;
        }
        const double outside = std::max(0.0, -std::min({weight[0], weight[1], weight[2]}) / sum);
        Vec3d met(0.0);
        Rgb value(0.0f);
        for (std::size_t i = 0; i < 3; ++i) {
            met += weight[i] / sum * c.position[i];
            value += static_cast<float>(weight[i] / sum) * mesh_.irradiance[c.index[i]];
        }
        const double distance = glm::distance(met, position);
        if (outside < leastOutside || (outside == leastOutside && distance < nearest)) {
            leastOutside = outside;
            nearest = distance;
            found = value;
        }
    }
    return found;
}

}  // namespace fluxwalk::bench
