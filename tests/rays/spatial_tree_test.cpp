#include "core/rays/spatial_tree.h"

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/rays/tree_builder.h"
#include "core/scene/builders.h"
#include "core/surface/region.h"
#include "tests/support/random_boxes.h"
#include "tests/support/random_scenes.h"

namespace fluxwalk {
namespace {

using base::Box;
using base::Executor;
using base::Vec3d;
using rays::SpatialTree;
using rays::TreeBuilder;
using test::randomBoxes;
using test::surfaceCost;

constexpr std::array kBuilders = {TreeBuilder::sah, TreeBuilder::hybrid, TreeBuilder::embree};

class TreeBuilders : public testing::TestWithParam<TreeBuilder> {
  protected:
    SpatialTree build(const std::vector<Box>& boxes, unsigned threads = 1) const {
        return rays::buildTree(GetParam(), {boxes}, Executor(threads));
    }
};

std::string nameOf(const testing::TestParamInfo<TreeBuilder>& test) {
    constexpr std::array kNames = {"sah", "hybrid", "embree"};
    return kNames.at(static_cast<std::size_t>(test.param));
}

INSTANTIATE_TEST_SUITE_P(All, TreeBuilders, testing::ValuesIn(kBuilders), nameOf);

std::vector<base::NormalCone> randomCones(std::uint64_t key, std::size_t count) {
    base::RandomStream random(key);
    std::vector<base::NormalCone> cones(count);
    for (base::NormalCone& cone : cones) {
        cone = {test::randomDirection(random), random.next()};
    }
    return cones;
}

std::vector<Box> patchBoxes(const scene::Scene& scene) {
    std::vector<Box> boxes;
    for (const scene::Object& object : scene.objects) {
        for (std::uint32_t p = 0; p < object.surface->patchCount(); ++p) {
            boxes.push_back(object.surface->bounds(p, surface::wholePatch(object.surface->domain(p))).box);
        }
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

TEST_P(TreeBuilders, areSoundAndOfModestDepth) {
    for (const std::size_t count : {2u, 3u, 8u, 9u, 10u, 1000u, 20000u}) {
        const std::vector<Box> boxes = randomBoxes(count, count, 0.3);
        const std::size_t depth = expectSound(build(boxes, 2), boxes);
        EXPECT_LT(static_cast<double>(depth), 4.0 * std::log2(static_cast<double>(count)) + 2.0);
    }
}

TEST_P(TreeBuilders, giveTheSameTreeForAnyNumberOfThreads) {
    // More items than are summed up or built in one go.
    const std::vector<Box> boxes = randomBoxes(5, 60000, 0.2);
    const std::vector<base::NormalCone> normals = randomCones(6, boxes.size());
    const std::vector<double> areas(boxes.size(), 0.3);
    const auto make = [&](unsigned threads) {
        return rays::buildTree(GetParam(), {boxes, normals, areas}, Executor(threads));
    };
    const SpatialTree one = make(1);
    expectSound(one, boxes);
    for (const unsigned threads : {2u, 8u}) {
        for (int again = 0; again < 2; ++again) {
            EXPECT_TRUE(areIdentical(one, make(threads))) << threads;
        }
    }
}

TEST_P(TreeBuilders, separateWhatIsApart) {
    // Two clouds far from each other are the two halves.
    std::vector<Box> boxes = randomBoxes(6, 100, 0.3);
    for (std::size_t i = 0; i < 50; ++i) {
        boxes[2 * i].lower.x += 1000.0;
        boxes[2 * i].upper.x += 1000.0;
    }
    const SpatialTree tree = build(boxes);
    const auto nodes = tree.nodes();
    const SpatialTree::Node& left = nodes[1];
    const SpatialTree::Node& right = nodes[nodes[0].right];
    EXPECT_LT(std::min(left.upper.x, right.upper.x), 20.0f);
    EXPECT_GT(std::max(left.lower.x, right.lower.x), 900.0f);
}

TEST_P(TreeBuilders, takeNoneAndOne) {
    EXPECT_TRUE(build({}).isEmpty());
    EXPECT_TRUE(SpatialTree().isEmpty());
    const SpatialTree tree = build(randomBoxes(7, 1, 1.0));
    ASSERT_EQ(tree.nodes().size(), 1u);
    EXPECT_TRUE(tree.nodes()[0].isLeaf());
    EXPECT_EQ(tree.nodes()[0].item, 0u);
}

TEST_P(TreeBuilders, halveWhatLiesInOnePlace) {
    const std::vector<Box> points(200, Box{Vec3d(1.0, 2.0, 3.0), Vec3d(1.0, 2.0, 3.0)});
    EXPECT_LE(expectSound(build(points), points), 9u);
    // 2^13 is the next power of two.
    const std::vector<Box> same(5000, Box{Vec3d(0.0), Vec3d(1.0)});
    EXPECT_LE(expectSound(build(same, 2), same), 14u);
    std::vector<Box> nested;
    for (int i = 0; i < 5000; ++i) {
        nested.push_back({Vec3d(-1.0 - i), Vec3d(1.0 + i)});
    }
    EXPECT_LE(expectSound(build(nested, 2), nested), SpatialTree::kMaxDepth);
}

TEST_P(TreeBuilders, takeFlatAndThinBoxes) {
    std::vector<Box> flat = randomBoxes(8, 500, 1.0);
    for (Box& box : flat) {
        box.lower.y = box.upper.y = 0.25;
    }
    EXPECT_LE(expectSound(build(flat), flat), 40u);
    std::vector<Box> line = randomBoxes(8, 500, 0.0);
    for (Box& box : line) {
        box.lower.y = box.upper.y = box.lower.z = box.upper.z = -7.0;
    }
    EXPECT_LE(expectSound(build(line), line), SpatialTree::kMaxDepth);
}

TEST_P(TreeBuilders, takeDustBesideAGiantFarFromTheOrigin) {
    std::vector<Box> mixed = randomBoxes(9, 3000, 1e-3);
    for (Box& box : mixed) {
        box.lower += Vec3d(1e6);
        box.upper += Vec3d(1e6);
    }
    mixed.push_back({Vec3d(1e6 - 5000.0), Vec3d(1e6 + 5000.0)});
    EXPECT_LE(expectSound(build(mixed), mixed), SpatialTree::kMaxDepth);
    mixed.push_back({Vec3d(-1e9), Vec3d(1e9)});
    EXPECT_LE(expectSound(build(mixed), mixed), SpatialTree::kMaxDepth);
    const std::vector<Box> huge = randomBoxes(10, 50, 1e30);
    EXPECT_LE(expectSound(build(huge), huge), SpatialTree::kMaxDepth);
}

TEST_P(TreeBuilders, boundTheDepthWherePlacesGrowExponentially) {
    // Each split by surface would take away the few outermost ones.
    std::vector<Box> boxes;
    for (int i = 0; i < 400; ++i) {
        const double at = std::ldexp(1.0, i % 100 - 50);
        boxes.push_back({Vec3d(at, 0.0, 0.0), Vec3d(1.1 * at, at, at)});
    }
    EXPECT_LE(expectSound(build(boxes), boxes), SpatialTree::kMaxDepth - 1);
}

TEST(SpatialTree, farOffOriginsCostNoQuality) {
    // Exact in double, far below the steps of float at 1e6 m.
    const std::vector<Box> boxes = randomBoxes(14, 2000, 0.02);
    std::vector<Box> far = boxes;
    for (Box& box : far) {
        box.lower += Vec3d(0x1p20);
        box.upper += Vec3d(0x1p20);
    }
    const SpatialTree near = rays::buildTree(TreeBuilder::sah, {boxes}, Executor(1));
    const SpatialTree moved = rays::buildTree(TreeBuilder::sah, {far}, Executor(1));
    std::size_t same = 0;
    for (std::size_t i = 0; i < near.nodes().size(); ++i) {
        same += near.nodes()[i].item == moved.nodes()[i].item ? 1u : 0u;
    }
    EXPECT_EQ(same, near.nodes().size());
}

TEST(SpatialTree, ownBuilderIsNoWorseThanEmbrees) {
    const auto compare = [](const std::vector<Box>& boxes) {
        const double embree = surfaceCost(rays::buildTree(TreeBuilder::embree, {boxes}, Executor(1)));
        EXPECT_LE(surfaceCost(rays::buildTree(TreeBuilder::sah, {boxes}, Executor(1))), 1.05 * embree);
        EXPECT_LE(surfaceCost(rays::buildTree(TreeBuilder::hybrid, {boxes}, Executor(1))), 1.15 * embree);
    };
    compare(patchBoxes(scene::buildGallery()));
    compare(patchBoxes(test::randomScene(15, 1, 20000, 0, 0.05)));
    compare(randomBoxes(16, 20000, 0.4));
}

TEST(SpatialTree, normalsPartTheTwoSidesOfAWall) {
    // Tiles 5 cm apart that face away from each other.
    std::vector<Box> boxes;
    std::vector<base::NormalCone> normals;
    for (int i = 0; i < 64; ++i) {
        const Vec3d at(i / 2 % 8, i / 16, i % 2 == 0 ? 0.0 : -0.05);
        boxes.push_back({at, at + Vec3d(1.0, 1.0, 0.0)});
        normals.push_back({Vec3d(0.0, 0.0, i % 2 == 0 ? 1.0 : -1.0), 0.0});
    }
    const std::vector<double> areas(boxes.size(), 1.0);
    // Tiles of the front in the root's left half.
    const auto frontsLeft = [](const SpatialTree& tree) {
        std::size_t fronts = 0;
        for (std::uint32_t i = 1; i < tree.nodes()[0].right; ++i) {
            fronts += tree.nodes()[i].isLeaf() && tree.nodes()[i].item % 2 == 0 ? 1u : 0u;
        }
        return fronts;
    };
    EXPECT_EQ(frontsLeft(rays::buildTree(TreeBuilder::sah, {boxes}, Executor(1))), 16u);
    const std::size_t parted =
        frontsLeft(rays::buildTree(TreeBuilder::sah, {boxes, normals, areas}, Executor(1)));
    EXPECT_TRUE(parted == 0 || parted == 32) << parted;
}

TEST(SpatialTree, evenRegionsBecomeGrids) {
    const auto gridsOf = [](const std::vector<Box>& boxes) {
        const SpatialTree tree = rays::buildTree(TreeBuilder::hybrid, {boxes}, Executor(2));
        std::uint32_t end = 0;
        for (const rays::TreeGrid& grid : tree.grids()) {
            EXPECT_GE(grid.node, end) << "below another grid";
            // Down its right edge to the last node below.
            for (end = grid.node; !tree.nodes()[end].isLeaf();) {
                end = tree.nodes()[end].right;
            }
        }
        return std::vector<rays::TreeGrid>(tree.grids().begin(), tree.grids().end());
    };
    const std::vector<rays::TreeGrid> even = gridsOf(randomBoxes(17, 30000, 0.2));
    ASSERT_EQ(even.size(), 1u);
    EXPECT_EQ(even[0].node, 0u);
    for (const std::uint32_t count : even[0].cells) {
        EXPECT_NEAR(count, std::cbrt(30000 / 1.5), 2.0);
    }
    // Two even regions far apart: the space between is no part of a grid.
    std::vector<Box> two = randomBoxes(18, 8000, 0.2);
    for (std::size_t i = 0; i < two.size(); i += 2) {
        two[i].lower.z += 500.0;
        two[i].upper.z += 500.0;
    }
    EXPECT_EQ(gridsOf(two).size(), 2u);
    // Boxes that overlap many cells are not for a grid.
    EXPECT_TRUE(gridsOf(randomBoxes(19, 3000, 5.0)).empty());
}

TEST(SpatialTree, joins) {
    const std::vector<Box> a = randomBoxes(11, 20, 0.5);
    const std::vector<Box> b = randomBoxes(12, 13, 0.5);
    std::vector<Box> both = a;
    both.insert(both.end(), b.begin(), b.end());
    const SpatialTree first = rays::buildTree(TreeBuilder::sah, {a}, Executor(1));
    const SpatialTree second = rays::buildTree(TreeBuilder::sah, {b}, Executor(1));
    expectSound(SpatialTree::join(first, second, 20), both);
    EXPECT_TRUE(areIdentical(SpatialTree::join(first, SpatialTree(), 20), first));
    EXPECT_TRUE(SpatialTree::join(SpatialTree(), SpatialTree(), 0).isEmpty());
    const std::vector<Box> even = randomBoxes(13, 4000, 0.3);
    const SpatialTree grid = rays::buildTree(TreeBuilder::hybrid, {even}, Executor(1));
    ASSERT_EQ(grid.grids().size(), 1u);
    const SpatialTree behind = SpatialTree::join(first, grid, 20);
    EXPECT_EQ(behind.grids()[0].node, 1 + first.nodes().size());
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
