#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "tests/support/solving.h"

// Elements that nothing needs any more are taken back.

namespace fluxwalk {

namespace {

using base::NodeId;
using hierarchy::Hierarchy;

// Quarters every patch, and the first quarter of each again.
std::unique_ptr<test::Problem> makeSplit(const char* scene) {
    auto problem = test::makeProblem(*scene::buildScene(scene));
    Hierarchy& h = problem->hierarchy;
    const std::vector<NodeId> patches(h.patches().begin(), h.patches().end());
    h.split(patches, problem->executor);
    std::vector<NodeId> first;
    for (const NodeId id : patches) {
        first.push_back(h.child(id, 0));
    }
    h.split(first, problem->executor);
    return problem;
}

void expectSame(const Hierarchy& a, const Hierarchy& b) {
    ASSERT_EQ(a.nodeCount(), b.nodeCount());
    EXPECT_EQ(a.leafCount(), b.leafCount());
    for (std::uint32_t i = 0; i < a.nodeCount(); ++i) {
        const NodeId id{i};
        EXPECT_EQ(a.key(id), b.key(id));
        EXPECT_EQ(a.parent(id), b.parent(id));
        EXPECT_EQ(a.isLeaf(id), b.isLeaf(id));
        EXPECT_EQ(a.shape(id).exposed, b.shape(id).exposed) << i;
        EXPECT_EQ(a.shape(id).area, b.shape(id).area);
    }
    EXPECT_EQ(a.sampledAreaBefore(a.patches().size()), b.sampledAreaBefore(b.patches().size()));
}

}  // namespace

// Parts of the box's floor are hidden under its blocks.
TEST(Prune, everythingComesBackAsBuilt) {
    const auto built = test::makeProblem(*scene::buildScene("cornell-box"));
    const auto split = makeSplit("cornell-box");
    Hierarchy& h = split->hierarchy;
    const std::size_t before = h.nodeCount();
    EXPECT_EQ(before, built->hierarchy.nodeCount() + 8 * h.patches().size());
    const std::vector<NodeId> places = h.prune(std::vector<std::uint8_t>(before, 0));
    EXPECT_EQ(places.size(), before);
    expectSame(h, built->hierarchy);
}

TEST(Prune, whatIsNeededStaysWithItsSiblings) {
    const auto split = makeSplit("cornell-box");
    Hierarchy& h = split->hierarchy;
    const NodeId patch = h.patches()[1];
    const NodeId deep = h.child(h.child(patch, 0), 2);
    const std::uint64_t key = h.key(deep);
    const std::size_t built = h.nodeCount() - 8 * h.patches().size();
    std::vector<std::uint8_t> isNeeded(h.nodeCount(), 0);
    isNeeded[base::index(deep)] = 1;
    const std::vector<NodeId> places = h.prune(isNeeded);
    EXPECT_EQ(h.nodeCount(), built + 8);
    EXPECT_EQ(h.leafCount(), h.patches().size() + 6);
    const NodeId moved = places[base::index(deep)];
    ASSERT_NE(moved, NodeId::none);
    EXPECT_EQ(h.key(moved), key);
    EXPECT_EQ(h.child(h.child(patch, 0), 2), moved);
    EXPECT_EQ(h.parent(h.parent(moved)), patch);
    EXPECT_TRUE(h.isLeaf(h.child(patch, 3)));
    EXPECT_TRUE(h.isLeaf(h.patches()[0]));
}

// An inner element's own link keeps its block, not what is below.
TEST(Prune, linkedElementsLoseWhatIsBelow) {
    const auto split = makeSplit("furnace");
    Hierarchy& h = split->hierarchy;
    std::vector<std::uint8_t> isNeeded(h.nodeCount(), 0);
    for (const NodeId id : h.patches()) {
        isNeeded[base::index(h.child(id, 0))] = 1;
    }
    const std::size_t built = h.nodeCount() - 8 * h.patches().size();
    h.prune(isNeeded);
    EXPECT_EQ(h.nodeCount(), built + 4 * h.patches().size());
    EXPECT_EQ(h.leafCount(), 4 * h.patches().size());
    // And what was taken back can be split again.
    const std::vector<NodeId> again{h.child(h.patches()[0], 0)};
    h.split(again, split->executor);
    EXPECT_EQ(h.leafCount(), 4 * h.patches().size() + 3);
}

}  // namespace fluxwalk
