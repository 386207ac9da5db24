#include "core/solve/cluster_exchange.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/scene/builders.h"
#include "core/solve/row_scaling.h"
#include "core/transport/cluster_factor.h"
#include "tests/solve/linked_cloud.h"

// Links of clusters carry what they say: all that is sent arrives, the same in both directions.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using hierarchy::Link;
using hierarchy::NodeKind;
using test::Problem;

}  // namespace

// One link at a time, light of all colours.
TEST(ClusterExchange, allThatIsSentArrives) {
    const auto problem = test::makeLinkedCloud(test::withClusterLinks());
    hierarchy::Hierarchy& h = problem->hierarchy;
    const std::vector<Link> all = problem->links.links;
    const std::size_t clusterLinks = problem->links.clusterLinks;
    int looked = 0;
    for (std::size_t i = 0; i < clusterLinks; i += 17) {
        problem->links.links = {all[i]};
        problem->links.clusterLinks = 1;
        problem->links.index(h.nodeCount());
        solve::ClusterExchange exchange(*problem, problem->rowScale);
        std::vector<Rgb> out(h.patches().size());
        exchange.gather(0, out.size(), out);
        Vec3d arriving(0.0);
        for (std::size_t k = 0; k < out.size(); ++k) {
            arriving += static_cast<double>(h.shape(h.patches()[k]).exposedArea()) * Vec3d(out[k]);
        }
        Vec3d sent(0.0);
        for (const NodeId end : {all[i].a, all[i].b}) {
            if (h.kind(end) == NodeKind::cluster) {
                const NodeId source = end == all[i].a ? all[i].b : all[i].a;
                sent += Vec3d(all[i].transfer() * exchange.shownBy(0, source));
            }
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(arriving[c], sent[c], 1e-5 * sent[c]);
        }
        looked += sent.x > 0.0 ? 1 : 0;
    }
    EXPECT_GT(looked, 20);
}

// Where all glow alike, an end shows just that.
TEST(ClusterExchange, constantsAreShownAsTheyAre) {
    const auto problem = test::makeLinkedCloud(test::withClusterLinks());
    const solve::ClusterExchange exchange(*problem, problem->rowScale, true);
    for (std::size_t i = 0; i < problem->links.clusterLinks; ++i) {
        for (const NodeId end : {problem->links.links[i].a, problem->links.links[i].b}) {
            EXPECT_NEAR(static_cast<double>(exchange.shownBy(i, end).g), 1.0, 1e-5);
        }
    }
}

TEST(ClusterExchange, transportIsItsOwnAdjoint) {
    const auto problem = test::makeLinkedCloud(test::withClusterLinks());
    EXPECT_GT(problem->hierarchy.leafCount(), problem->hierarchy.patches().size());
    EXPECT_NEAR(test::adjointRatio(*problem), 1.0, 1e-5);
}

// No sum of a row may let light grow without end: reflectances here are .5, in buildings up to .85.
TEST(ClusterExchange, doesNotAmplify) {
    const auto problem = test::makeProblem(test::buildCloud(2000, 1), test::withClusterLinks());
    hierarchy::Hierarchy& h = problem->hierarchy;
    test::setReflectance(*problem, .85f);
    test::refine(*problem, 1e-1);
    const int sweeps = test::converge(*problem, 1e-5, 300);
    EXPECT_LT(sweeps, 300);
    for (const NodeId id : h.patches()) {
        EXPECT_TRUE(std::isfinite(h.light(id).irradiance.g));
    }
    // Not because many are held back.
    const std::vector<float> kept = solve::limitRows(*problem);
    double held = 0.0;
    double all = 0.0;
    for (const NodeId id : test::leavesOf(h)) {
        const auto area = static_cast<double>(h.shape(id).exposedArea());
        held += !kept.empty() && kept[base::index(id)] < 1.0f ? area : 0.0;
        all += area;
    }
    EXPECT_LT(held, .01 * all);
}

TEST(ClusterExchange, isTheSameForAnyNumberOfThreads) {
    const auto one = test::makeLinkedCloud(test::withClusterLinks(), 1);
    const auto eight = test::makeLinkedCloud(test::withClusterLinks(), 8);
    ASSERT_EQ(one->links.links.size(), eight->links.links.size());
    for (std::size_t i = 0; i < one->links.links.size(); ++i) {
        const Link& a = one->links.links[i];
        const Link& b = eight->links.links[i];
        ASSERT_TRUE(a.a == b.a && a.b == b.b);
        ASSERT_EQ(a.coupling, b.coupling);
        ASSERT_EQ(a.visibilityBits, b.visibilityBits);
    }
    for (std::uint32_t i = 0; i < one->hierarchy.nodeCount(); ++i) {
        ASSERT_EQ(one->hierarchy.light(NodeId{i}).radiosity, eight->hierarchy.light(NodeId{i}).radiosity);
    }
}

}  // namespace fluxwalk
