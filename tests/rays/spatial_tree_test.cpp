#include "core/rays/spatial_tree.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace fluxwalk {
namespace {

using base::Box;
using base::Executor;
using base::Vec3d;
using rays::SpatialTree;

std::vector<Box> randomBoxes(std::uint64_t key, std::size_t count, double size) {
    base::RandomStream random(key);
    std::vector<Box> boxes(count);
    for (Box& box : boxes) {
        const double x = random.next();
        const double y = random.next();
        box.lower = 10.0 * Vec3d(x, y, random.next());
        const double w = random.next();
        const double h = random.next();
        box.upper = box.lower + size * Vec3d(w, h, random.next());
    }
    return boxes;
}

bool contains(const SpatialTree::Node& node, const Box& box) {
    for (int i = 0; i < 3; ++i) {
        if (static_cast<double>(node.lower[i]) > box.lower[i] ||
            static_cast<double>(node.upper[i]) < box.upper[i]) {
            return false;
        }
    }
    return true;
}

// Binary, depth-first, every item once, boxes within boxes. Returns the depth.
std::size_t expectSound(const SpatialTree& tree, const std::vector<Box>& boxes) {
    const auto nodes = tree.nodes();
    EXPECT_EQ(nodes.size(), 2 * boxes.size() - 1);
    std::vector<int> seen(boxes.size(), 0);
    struct Visit {
        std::uint32_t node;
        std::size_t depth;
    };
    std::vector<Visit> stack{{0, 1}};
    std::uint32_t next = 0;
    std::size_t deepest = 0;
    while (!stack.empty()) {
        const Visit at = stack.back();
        stack.pop_back();
        EXPECT_EQ(at.node, next++) << "not depth-first";
        deepest = std::max(deepest, at.depth);
        const SpatialTree::Node& node = nodes[at.node];
        EXPECT_EQ(node.isLeaf(), node.item != SpatialTree::kNone);
        if (node.isLeaf()) {
            ++seen.at(node.item);
            EXPECT_TRUE(contains(node, boxes[node.item]));
            continue;
        }
        for (const std::uint32_t child : {at.node + 1, node.right}) {
            const Box inner{Vec3d(nodes[child].lower), Vec3d(nodes[child].upper)};
            EXPECT_TRUE(contains(node, inner));
        }
        stack.push_back({node.right, at.depth + 1});
        stack.push_back({at.node + 1, at.depth + 1});
    }
    EXPECT_EQ(next, nodes.size());
    for (const int count : seen) {
        EXPECT_EQ(count, 1);
    }
    return deepest;
}

bool areIdentical(const SpatialTree& a, const SpatialTree& b) {
    return a.nodes().size() == b.nodes().size() &&
           std::memcmp(a.nodes().data(), b.nodes().data(), a.nodes().size_bytes()) == 0;
}

TEST(SpatialTree, isSoundAndOfModestDepth) {
    for (const std::size_t count : {2u, 3u, 10u, 1000u, 20000u}) {
        const std::vector<Box> boxes = randomBoxes(count, count, 0.3);
        const std::size_t depth = expectSound(SpatialTree(boxes, Executor(2)), boxes);
        EXPECT_LT(static_cast<double>(depth), 4.0 * std::log2(static_cast<double>(count)) + 2.0);
    }
}

TEST(SpatialTree, isTheSameForAnyNumberOfThreads) {
    const std::vector<Box> boxes = randomBoxes(5, 30000, 0.2);
    const SpatialTree one(boxes, Executor(1));
    for (const unsigned threads : {2u, 8u}) {
        for (int again = 0; again < 2; ++again) {
            EXPECT_TRUE(areIdentical(one, SpatialTree(boxes, Executor(threads)))) << threads;
        }
    }
}

TEST(SpatialTree, separatesWhatIsApart) {
    // Two clouds far from each other are the two halves.
    std::vector<Box> boxes = randomBoxes(6, 100, 0.3);
    for (std::size_t i = 0; i < 50; ++i) {
        boxes[2 * i].lower.x += 1000.0;
        boxes[2 * i].upper.x += 1000.0;
    }
    const SpatialTree tree(boxes, Executor(1));
    const auto nodes = tree.nodes();
    const SpatialTree::Node& left = nodes[1];
    const SpatialTree::Node& right = nodes[nodes[0].right];
    EXPECT_LT(std::min(left.upper.x, right.upper.x), 20.0f);
    EXPECT_GT(std::max(left.lower.x, right.lower.x), 900.0f);
}

TEST(SpatialTree, emptyAndSingle) {
    const SpatialTree none({}, Executor(1));
    EXPECT_TRUE(none.isEmpty());
    EXPECT_TRUE(SpatialTree().isEmpty());
    const std::vector<Box> one = randomBoxes(7, 1, 1.0);
    const SpatialTree tree(one, Executor(1));
    ASSERT_EQ(tree.nodes().size(), 1u);
    EXPECT_TRUE(tree.nodes()[0].isLeaf());
    EXPECT_EQ(tree.nodes()[0].item, 0u);
}

TEST(SpatialTree, degenerateBoxes) {
    std::vector<Box> points(200, Box{Vec3d(1.0, 2.0, 3.0), Vec3d(1.0, 2.0, 3.0)});
    expectSound(SpatialTree(points, Executor(1)), points);
    std::vector<Box> same(5000, Box{Vec3d(0.0), Vec3d(1.0)});
    expectSound(SpatialTree(same, Executor(2)), same);
    std::vector<Box> flat = randomBoxes(8, 500, 1.0);
    for (Box& box : flat) {
        box.lower.y = box.upper.y = 0.25;
    }
    expectSound(SpatialTree(flat, Executor(1)), flat);
    // Dust beside a giant, far from the origin.
    std::vector<Box> mixed = randomBoxes(9, 300, 1e-6);
    for (Box& box : mixed) {
        box.lower += Vec3d(1e6);
        box.upper += Vec3d(1e6);
    }
    mixed.push_back({Vec3d(-1e9), Vec3d(1e9)});
    expectSound(SpatialTree(mixed, Executor(1)), mixed);
    std::vector<Box> huge = randomBoxes(10, 50, 1e30);
    expectSound(SpatialTree(huge, Executor(1)), huge);
}

TEST(SpatialTree, joins) {
    const std::vector<Box> a = randomBoxes(11, 20, 0.5);
    const std::vector<Box> b = randomBoxes(12, 13, 0.5);
    std::vector<Box> both = a;
    both.insert(both.end(), b.begin(), b.end());
    const SpatialTree first(a, Executor(1));
    const SpatialTree second(b, Executor(1));
    expectSound(SpatialTree::join(first, second, 20), both);
    EXPECT_TRUE(areIdentical(SpatialTree::join(first, SpatialTree(), 20), first));
    EXPECT_TRUE(SpatialTree::join(SpatialTree(), SpatialTree(), 0).isEmpty());
    const SpatialTree shifted = SpatialTree::join(SpatialTree(), second, 20);
    ASSERT_EQ(shifted.nodes().size(), second.nodes().size());
    for (std::size_t i = 0; i < shifted.nodes().size(); ++i) {
        EXPECT_EQ(shifted.nodes()[i].right, second.nodes()[i].right);
        if (second.nodes()[i].isLeaf()) {
            EXPECT_EQ(shifted.nodes()[i].item, second.nodes()[i].item + 20);
        }
    }
}

}  // namespace
}  // namespace fluxwalk
