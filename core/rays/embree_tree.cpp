#include "core/rays/embree_tree.h"

#include <array>
#include <cmath>
#include <new>

#include <embree3/rtcore.h>

#include "core/base/check.h"
#include "core/rays/binned_tree.h"

namespace fluxwalk::rays {

namespace {

struct BuildNode {
    std::array<BuildNode*, 2> children{};
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

// Boxes are made anew from the items'.
void setBounds(void* /*node*/, const RTCBounds** /*bounds*/, unsigned /*count*/, void* /*user*/) {}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                 void* /*user*/) {
    auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode();
    node->item = count == 1 ? primitives[0].primID : SpatialTree::kNone;
    return node;
}

std::vector<RTCBuildPrimitive> makePrimitives(std::span<const base::Box> boxes) {
    std::vector<RTCBuildPrimitive> primitives(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const base::Vec3 lower(boxes[i].lower);
        const base::Vec3 upper(boxes[i].upper);
        FLUXWALK_CHECK(std::isfinite(lower.x + lower.y + lower.z + upper.x + upper.y + upper.z));
        primitives[i] = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, static_cast<unsigned>(i)};
    }
    return primitives;
}

// Depth-first copy: Embree's memory order is not deterministic, its topology is.
std::vector<SpatialTree::Node> copyTopology(const BuildNode* root, std::size_t leaves) {
    struct Pending {
        const BuildNode* node;
        std::uint32_t parent;
        bool isRight;
    };
    std::vector<SpatialTree::Node> nodes;
    nodes.reserve(2 * leaves);
    std::vector<Pending> stack{{root, SpatialTree::kNone, false}};
    while (!stack.empty()) {
        const Pending at = stack.back();
        stack.pop_back();
        const auto id = static_cast<std::uint32_t>(nodes.size());
        if (at.isRight) {
            nodes[at.parent].right = id;
        }
        SpatialTree::Node node;
        node.item = at.node->item;
        if (node.item == SpatialTree::kNone) {
            stack.push_back({at.node->children[1], id, true});
            stack.push_back({at.node->children[0], id, false});
        }
        nodes.push_back(node);
    }
    return nodes;
}

}  // namespace

SpatialTree buildEmbreeTree(std::span<const base::Box> boxes, const base::Executor& executor) {
    std::vector<RTCBuildPrimitive> primitives = makePrimitives(boxes);
    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCBVH bvh = rtcNewBVH(device);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.byteSize = sizeof(arguments);
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = SpatialTree::kMaxDepth - 1;
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
    std::vector<SpatialTree::Node> nodes;
    if (root != nullptr) {
        nodes = copyTopology(root, boxes.size());
    }
    rtcReleaseBVH(bvh);
    rtcReleaseDevice(device);
    return nodes.empty() ? buildBinnedTree({boxes}, {}, executor) : SpatialTree(std::move(nodes), {}, boxes);
}

}  // namespace fluxwalk::rays
