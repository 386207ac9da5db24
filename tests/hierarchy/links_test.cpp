#include "core/hierarchy/links.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/hierarchy/hierarchy.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using hierarchy::GradientCode;
using hierarchy::Link;
using hierarchy::LinkStore;
using hierarchy::UncertaintyCode;

TEST(UncertaintyCode, neverUnderestimatesAndRoundsUpByAtMostATwelfth) {
    // Within its range, but for the rounding of float.
    base::RandomStream random(1);
    for (int i = 0; i < 100'000; ++i) {
        const auto value = static_cast<float>(std::exp2(-19.9 + 31.7 * random.next()));
        const float stored = UncertaintyCode::decode(UncertaintyCode::encode(value));
        EXPECT_GE(stored, value * (1.0f - 1e-6f)) << value;
        EXPECT_LE(stored, value * 1.0906f) << value;
    }
}

TEST(UncertaintyCode, ends) {
    EXPECT_EQ(UncertaintyCode::encode(0.0f), 0);
    EXPECT_EQ(UncertaintyCode::encode(1e-6f), 0);
    EXPECT_EQ(UncertaintyCode::decode(0), 0.0f);
    EXPECT_GE(UncertaintyCode::decode(UncertaintyCode::encode(1.1e-6f)), 1.1e-6f);
    EXPECT_EQ(UncertaintyCode::encode(1e9f), 255);
    EXPECT_EQ(UncertaintyCode::encode(std::numeric_limits<float>::infinity()), 255);
    EXPECT_GT(UncertaintyCode::decode(255), 3700.0f);
    for (int code = 1; code < 256; ++code) {
        const int again = UncertaintyCode::encode(UncertaintyCode::decode(static_cast<std::uint8_t>(code)));
        EXPECT_TRUE(again == code || again == code + 1) << "rounding may lift it by one step";
    }
}

TEST(GradientCode, roundTripsToHalfAStepAndClamps) {
    base::RandomStream random(2);
    for (int i = 0; i < 10'000; ++i) {
        const base::Vec2 g(6.0 * random.next2() - 3.0);
        const base::Vec2 stored = GradientCode::encode(g).decode();
        EXPECT_NEAR(stored.x, g.x, 0.5f * GradientCode::kLargest / 127.0f + 1e-6f);
        EXPECT_NEAR(stored.y, g.y, 0.5f * GradientCode::kLargest / 127.0f + 1e-6f);
    }
    EXPECT_EQ(GradientCode::encode({0.0f, 0.0f}).decode(), base::Vec2(0.0f));
    const base::Vec2 most = GradientCode::encode({9.0f, -100.0f}).decode();
    EXPECT_FLOAT_EQ(most.x, GradientCode::kLargest);
    EXPECT_FLOAT_EQ(most.y, -GradientCode::kLargest);
}

TEST(Link, visibilityBits) {
    Link link;
    link.coupling = 2.0f;
    for (const bool open : {false, true}) {
        for (int i = 0; i <= 1000; ++i) {
            const float v = static_cast<float>(i) / 1000.0f;
            link.setVisibility(v, open);
            EXPECT_NEAR(link.visibility(), v, 0.5f / 32767.0f + 1e-7f);
            EXPECT_EQ(link.isOpen(), open);
            EXPECT_FLOAT_EQ(link.transfer(), 2.0f * link.visibility());
        }
        link.setVisibility(1.0f, open);
        EXPECT_EQ(link.visibility(), 1.0f);
        link.setVisibility(0.0f, open);
        EXPECT_EQ(link.visibility(), 0.0f);
    }
}

TEST(LinkStore, listsEveryLinkAtItsEnds) {
    base::RandomStream random(3);
    const std::uint32_t nodes = 50;
    LinkStore store;
    for (int i = 0; i < 1000; ++i) {
        Link link;
        link.a = NodeId{static_cast<std::uint32_t>(random.next() * nodes)};
        link.b = NodeId{static_cast<std::uint32_t>(random.next() * (nodes - 1))};  // the last has few
        store.links.push_back(link);
    }
    store.index(nodes + 1);
    std::size_t ends = 0;
    for (std::uint32_t n = 0; n <= nodes; ++n) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t l = 0; l < store.links.size(); ++l) {
            if (store.links[l].a == NodeId{n} || store.links[l].b == NodeId{n}) {
                expected.push_back(l);
            }
        }
        const auto listed = store.endingAt(NodeId{n});
        EXPECT_TRUE(std::equal(listed.begin(), listed.end(), expected.begin(), expected.end())) << n;
        ends += listed.size();
    }
    EXPECT_TRUE(store.endingAt(NodeId{nodes}).empty());
    EXPECT_LT(ends, 2000u) << "links of a node with itself stand once";
    // Indexing again after a change forgets what was.
    store.links.resize(1);
    store.links[0].a = store.links[0].b = NodeId{0};
    store.index(1);
    ASSERT_EQ(store.endingAt(NodeId{0}).size(), 1u);
    store.links.clear();
    store.index(2);
    EXPECT_TRUE(store.endingAt(NodeId{1}).empty());
}

TEST(Memory, bytesPerNodeAndPerLinkAndDirection) {
    EXPECT_LE(hierarchy::Hierarchy::bytesPerNode(), 200u);
    // A link is 20 bytes and stands in the lists of its two ends with 4 bytes each: 28 bytes for an unordered
    // pair, 14 for each direction.
    LinkStore store;
    const std::uint32_t nodes = 100;
    for (std::uint32_t i = 0; i < 10'000; ++i) {
        Link link;
        link.a = NodeId{i % nodes};
        link.b = NodeId{(i / nodes + i + 1) % nodes};
        if (link.a != link.b) {
            store.links.push_back(link);
        }
    }
    store.index(nodes);
    const std::size_t perNode = (nodes + 1) * sizeof(std::uint32_t);
    EXPECT_EQ(store.bytes() - perNode, store.links.size() * 28);
    EXPECT_LE(static_cast<double>(store.bytes()) / (2.0 * static_cast<double>(store.links.size())), 16.0);
}

}  // namespace
}  // namespace fluxwalk
