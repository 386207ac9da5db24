#include "core/rays/tree_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/base/check.h"
#include "core/rays/build_item.h"

namespace fluxwalk::rays {

namespace {

/// Relative rounding of a box's entry and exit in float: three operations, both ends.
constexpr float kSlack = 1e-6f;
/// Reciprocals of smaller components would leave the range of float.
constexpr float kSmallest = 1e-18f;

Float4 toFloat4(const base::Vec3& v) {
    return Float4{v.x, v.y, v.z, 0.0f};
}

// The three coordinates of a corner. The fourth lane is an index, and as a number perhaps denormal.
Float4 loadCorner(const float* corner) {
    Int4 bits;
    std::memcpy(&bits, corner, sizeof(bits));
    bits &= Int4{-1, -1, -1, 0};
    Float4 result;
    std::memcpy(&result, &bits, sizeof(result));
    return result;
}

/// A ray against boxes, in float.
struct BoxTest {
    Float4 origin;
    Float4 inverse{};
    float tNear;
    float tFar;

    explicit BoxTest(const Ray& ray)
        : origin(toFloat4(ray.origin)), tNear(ray.tNear * (1.0f - kSlack)), tFar(ray.tFar * (1.0f + kSlack)) {
        for (int k = 0; k < 3; ++k) {
            const float d = ray.direction[k];
            inverse[k] = 1.0f / (std::abs(d) < kSmallest ? std::copysign(kSmallest, d) : d);
        }
    }

    // Entry, or infinity where the ray misses.
    float enter(const SpatialTree::Node& node) const {
        const Float4 a = (loadCorner(&node.lower.x) - origin) * inverse;
        const Float4 b = (loadCorner(&node.upper.x) - origin) * inverse;
        const Float4 near = minOf(a, b);
        const Float4 far = maxOf(a, b);
        const float first = std::max(std::max(near[0], near[1]), std::max(near[2], tNear));
        const float last = std::min(std::min(far[0], far[1]), far[2]) * (1.0f + kSlack);
        return first <= std::min(last, tFar) ? first : INFINITY;
    }
};

/// Curved objects have many patches, but each object meets a ray once: the last few that did not.
class Missed {
  public:
    bool holds(std::uint32_t object) const {
        return std::find(objects_.begin(), objects_.end(), object) != objects_.end();
    }
    void add(std::uint32_t object) {
        objects_[next_] = object;
        next_ = (next_ + 1) % objects_.size();
    }

  private:
    std::array<std::uint32_t, 8> objects_{~0u, ~0u, ~0u, ~0u, ~0u, ~0u, ~0u, ~0u};
    std::size_t next_ = 0;
};

/// Leaves lie in several cells, but need to be tested once: the last ones that were.
class Tested {
  public:
    /// False where it is known already.
    bool add(std::uint32_t leaf) {
        std::uint32_t& place = leaves_[leaf % leaves_.size()];
        const bool isNew = place != leaf;
        place = leaf;
        return isNew;
    }

  private:
    // No leaf is the root of a grid.
    std::array<std::uint32_t, 16> leaves_{};
};

}  // namespace

struct TreeRays::Query {
    explicit Query(const Ray& ray)
        : origin(ray.origin),
          direction(ray.direction),
          tNear(static_cast<double>(ray.tNear)),
          tFar(static_cast<double>(ray.tFar)) {}

    base::Vec3d origin;
    base::Vec3d direction;
    double tNear;
    double tFar;
    Missed missed;

    // Where the ray meets a triangle. The volumes with the edges change nothing but their sign with an edge's
    // direction: of two triangles at an edge, at least one is met.
    std::optional<double> meet(const base::Vec3d& a, const base::Vec3d& b, const base::Vec3d& c) const {
        const base::Vec3d pa = a - origin;
        const base::Vec3d pb = b - origin;
        const base::Vec3d pc = c - origin;
        const double ab = glm::dot(glm::cross(pa, pb), direction);
        const double bc = glm::dot(glm::cross(pb, pc), direction);
        const double ca = glm::dot(glm::cross(pc, pa), direction);
        if (std::min({ab, bc, ca}) < 0.0 && std::max({ab, bc, ca}) > 0.0) {
            return std::nullopt;
        }
        const base::Vec3d normal = glm::cross(b - a, c - a);
        const double t = glm::dot(pa, normal) / glm::dot(direction, normal);
        return t > tNear && t < tFar ? std::optional(t) : std::nullopt;
    }
};

TreeRays::TreeRays(std::shared_ptr<const PatchTree> patches, const Occluders& occluders,
                   const base::Executor& executor)
    : patches_(std::move(patches)),
      occluders_(&occluders),
      parts_(patches_->items.size()),
      cells_(patches_->tree, executor) {
    collectTriangles();
    const std::span<const TreeGrid> grids = patches_->tree.grids();
    if (!grids.empty()) {
        gridOfNode_.assign(patches_->tree.nodes().size(), SpatialTree::kNone);
        for (std::uint32_t i = 0; i < grids.size(); ++i) {
            gridOfNode_[grids[i].node] = i;
        }
    }
}

void TreeRays::collectTriangles() {
    // Triangles by patch, as the views list patches by triangle.
    std::vector<std::uint32_t> next(parts_.size() + 1, 0);
    const auto forTriangles = [&](const auto& body) {
        for (std::size_t o = 0; o < occluders_->objects.size(); ++o) {
            const Occluder& occluder = occluders_->objects[o];
            for (std::size_t t = 0; t < occluder.patches.size(); ++t) {
                body(patches_->firstItem[o] + occluder.patches[t], occluder, t);
            }
        }
    };
    forTriangles([&](std::uint32_t item, const Occluder&, std::size_t) { ++parts_[item].count; });
    std::uint32_t end = 0;
    for (const SpatialTree::Node& node : patches_->tree.nodes()) {
        if (node.isLeaf()) {
            parts_[node.item].first = end;
            next[node.item] = end;
            end += parts_[node.item].count;
        }
    }
    triangles_.resize(end);
    forTriangles([&](std::uint32_t item, const Occluder& occluder, std::size_t t) {
        const surface::TriangleView view = occluder.surface->triangles();
        const auto& [a, b, c] = view.triangles[t];
        triangles_[next[item]++] = {view.positions[a], view.positions[b], view.positions[c]};
    });
}

bool TreeRays::isMet(std::uint32_t item, Query& query) const {
    const auto [object, patch] = patches_->items[item];
    const Occluder& occluder = occluders_->objects[object];
    if (occluder.surface == nullptr) {
        return false;
    }
    if (occluder.patches.empty()) {
        if (query.missed.holds(object)) {
            return false;
        }
        if (occluder.meet(query.origin, query.direction, query.tNear, query.tFar)) {
            return true;
        }
        query.missed.add(object);
        return false;
    }
    const Part part = parts_[item];
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
        const Triangle& triangle = triangles_[i];
        const auto t = query.meet(base::Vec3d(triangle.a), base::Vec3d(triangle.b), base::Vec3d(triangle.c));
        if (t &&
            (occluder.cutOut == nullptr ||
             !occluder.isHole(patch, occluder.surface->locate(patch, query.origin + *t * query.direction)))) {
            return true;
        }
    }
    return false;
}

bool TreeRays::isOccluded(const Ray& ray) const {
    const std::span<const SpatialTree::Node> nodes = patches_->tree.nodes();
    const BoxTest boxes(ray);
    if (nodes.empty() || boxes.enter(nodes[0]) == INFINITY) {
        return false;
    }
    Query query(ray);
    Tested tested;
    std::array<std::uint32_t, SpatialTree::kMaxDepth> stack;
    std::size_t depth = 0;
    std::uint32_t at = 0;
    while (true) {
        const SpatialTree::Node& node = nodes[at];
        if (node.isLeaf()) {
            if (isMet(node.item, query)) {
                return true;
            }
        } else if (!gridOfNode_.empty() && gridOfNode_[at] != SpatialTree::kNone) {
            const auto isHit = [&](std::uint32_t leaf) {
                return tested.add(leaf) && boxes.enter(nodes[leaf]) != INFINITY &&
                       isMet(nodes[leaf].item, query);
            };
            if (cells_.walk(gridOfNode_[at], query.origin, query.direction, query.tNear, query.tFar, isHit)) {
                return true;
            }
        } else {
            const float left = boxes.enter(nodes[at + 1]);
            const float right = boxes.enter(nodes[node.right]);
            if (left != INFINITY || right != INFINITY) {
                const bool isLeftFirst = left <= right;
                if (left != INFINITY && right != INFINITY) {
                    stack[depth++] = isLeftFirst ? node.right : at + 1;
                }
                at = isLeftFirst ? at + 1 : node.right;
                continue;
            }
        }
        if (depth == 0) {
            return false;
        }
        at = stack[--depth];
    }
}

}  // namespace fluxwalk::rays
