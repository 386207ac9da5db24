#include "core/rays/spatial_tree.h"

#include <array>
#include <cmath>
#include <new>

#include <embree3/rtcore.h>

#include "core/base/check.h"

namespace fluxwalk::rays {

namespace {

struct BuildNode {
    std::array<BuildNode*, 2> children{};
    std::array<RTCBounds, 2> childBounds{};
    std::uint32_t item = SpatialTree::kNone;
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned /*childCount*/, void* /*user*/) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode();
}

void setChildren(void* node, void** children, unsigned count, void* /*user*/) {
    for (unsigned i = 0; i < count && i < 2; ++i) {
        static_cast<BuildNode*>(node)->children[i] = static_cast<BuildNode*>(children[i]);
    }
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/) {
    for (unsigned i = 0; i < count && i < 2; ++i) {
        static_cast<BuildNode*>(node)->childBounds[i] = *bounds[i];
    }
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                 void* /*user*/) {
    auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode();
    node->item = count == 1 ? primitives[0].primID : SpatialTree::kNone;
    return node;
}

// Float box that holds the double box.
void roundOut(const base::Box& box, base::Vec3& lower, base::Vec3& upper) {
    for (int i = 0; i < 3; ++i) {
        lower[i] = std::nextafter(static_cast<float>(box.lower[i]), -INFINITY);
        upper[i] = std::nextafter(static_cast<float>(box.upper[i]), INFINITY);
    }
}

}  // namespace

SpatialTree::SpatialTree(std::span<const base::Box> boxes, const base::Executor& executor) {
    if (boxes.empty()) {
        return;
    }
    std::vector<RTCBuildPrimitive> primitives(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        base::Vec3 lower;
        base::Vec3 upper;
        roundOut(boxes[i], lower, upper);
        FLUXWALK_CHECK(std::isfinite(lower.x + lower.y + lower.z + upper.x + upper.y + upper.z));
        primitives[i] = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, static_cast<unsigned>(i)};
    }
    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCBVH bvh = rtcNewBVH(device);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.byteSize = sizeof(arguments);
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = 1024;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = 1;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    const BuildNode* root = nullptr;
    executor.within([&] { root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments)); });
    FLUXWALK_CHECK(root != nullptr);

    // Depth-first copy: Embree's memory order is not deterministic, its topology is.
    struct Pending {
        const BuildNode* node;
        std::uint32_t parent;
        bool isRight;
    };
    nodes_.reserve(2 * boxes.size());
    std::vector<Pending> stack{{root, kNone, false}};
    while (!stack.empty()) {
        const Pending at = stack.back();
        stack.pop_back();
        const auto id = static_cast<std::uint32_t>(nodes_.size());
        if (at.isRight) {
            nodes_[at.parent].right = id;
        }
        Node node;
        node.item = at.node->item;
        if (node.item != kNone) {
            roundOut(boxes[node.item], node.lower, node.upper);
        } else {
            stack.push_back({at.node->children[1], id, true});
            stack.push_back({at.node->children[0], id, false});
        }
        nodes_.push_back(node);
    }
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.item == kNone) {
            node.lower = glm::min(nodes_[i + 1].lower, nodes_[node.right].lower);
            node.upper = glm::max(nodes_[i + 1].upper, nodes_[node.right].upper);
        }
    }
    rtcReleaseBVH(bvh);
    rtcReleaseDevice(device);
}

SpatialTree SpatialTree::join(const SpatialTree& first, const SpatialTree& second, std::uint32_t itemOffset) {
    SpatialTree joined;
    const bool both = !first.isEmpty() && !second.isEmpty();
    const std::uint32_t head = both ? 1 : 0;
    if (both) {
        Node root;
        root.lower = glm::min(first.nodes_[0].lower, second.nodes_[0].lower);
        root.upper = glm::max(first.nodes_[0].upper, second.nodes_[0].upper);
        root.right = head + static_cast<std::uint32_t>(first.nodes_.size());
        joined.nodes_.push_back(root);
    }
    const auto append = [&joined](const SpatialTree& tree, std::uint32_t itemShift) {
        const auto base = static_cast<std::uint32_t>(joined.nodes_.size());
        for (Node node : tree.nodes_) {
            node.right = node.right == kNone ? kNone : node.right + base;
            node.item = node.item == kNone ? kNone : node.item + itemShift;
            joined.nodes_.push_back(node);
        }
    };
    append(first, 0);
    append(second, itemOffset);
    return joined;
}

}  // namespace fluxwalk::rays
