#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/hierarchy/local_frame.h"
#include "core/scene/builders.h"
#include "core/scene/polygons.h"
#include "core/surface/sphere.h"
#include "tests/support/solving.h"

// Check 9: pull and push on the hierarchies that solves make. Values are stored as floats, so sums of
// thousands of leaves agree to a few 1e-7.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Rgb;
using base::Vec3d;
using hierarchy::Hierarchy;
using hierarchy::NodeKind;
using test::Problem;

std::unique_ptr<Problem> makeFurnace() {
    solve::Options options;
    options.clusterLinks =
        solve::ClusterLinks::off;  // how clusters share is looked at in cluster_exchange_test.cpp
    auto problem = test::makeProblem(scene::buildFurnace(.5f, false), options);
    test::refine(*problem, 1e-4);
    return problem;
}

// A sphere, seen from outside, split evenly.
std::unique_ptr<Problem> makeSphere(unsigned levels) {
    scene::Scene scene;
    const std::uint32_t glowing = scene::addMaterial(scene, "glowing", Rgb(.5f), Rgb(1.0f));
    scene.objects.push_back({"sphere", std::make_shared<surface::Sphere>(Vec3d(1, 2, 3), 1.5), glowing});
    auto problem = test::makeProblem(std::move(scene));
    for (unsigned level = 0; level < levels; ++level) {
        problem->hierarchy.split(test::leavesOf(problem->hierarchy), problem->executor);
    }
    problem->links.index(problem->hierarchy.nodeCount());
    return problem;
}

// Black elements whose leaves emit what `emission` says; nothing has arrived or been pulled yet.
template <class Emission>
void light(Problem& problem, const Emission& emission) {
    Hierarchy& h = problem.hierarchy;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) == NodeKind::element) {
            h.light(id) = {};
            h.light(id).emission = h.isLeaf(id) ? emission(i) : Rgb(0.0f);
        }
    }
}

Rgb randomColour(std::uint64_t key) {
    base::RandomStream random(base::combine(9, key));
    const double r = random.next();
    const double g = random.next();
    return Rgb(Vec3d(r, g, random.next()));
}

Vec3d powerOf(const Problem& problem, const std::vector<NodeId>& nodes) {
    Vec3d power(0.0);
    for (const NodeId id : nodes) {
        power += static_cast<double>(problem.hierarchy.shape(id).exposedArea()) *
                 Vec3d(problem.hierarchy.light(id).radiosity);
    }
    return power;
}

void expectEqual(const Vec3d& a, const Vec3d& b, double relative) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c] / b[c], 1.0, relative) << "channel " << c;
    }
}

// Leaves below a node.
std::vector<NodeId> leavesBelow(const Hierarchy& h, NodeId top) {
    std::vector<NodeId> leaves;
    std::vector<NodeId> stack{top};
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        if (h.isLeaf(id)) {
            leaves.push_back(id);
            continue;
        }
        for (unsigned c = 0; c < 4; ++c) {
            stack.push_back(h.child(id, c));
        }
    }
    return leaves;
}

void expectPullConservesPower(Problem& problem) {
    light(problem, randomColour);
    solve::Sweeper(problem).sweep();
    for (const NodeId patch : problem.hierarchy.patches()) {
        const std::vector<NodeId> leaves = leavesBelow(problem.hierarchy, patch);
        EXPECT_GE(leaves.size(), 4u);
        expectEqual(powerOf(problem, {patch}), powerOf(problem, leaves), 1e-6);
    }
}

void expectConstantsAreKept(Problem& problem) {
    light(problem, [](std::uint32_t) { return Rgb(.3f, .7f, 1.1f); });
    solve::Sweeper(problem).sweep();
    const Hierarchy& h = problem.hierarchy;
    for (std::uint32_t i = 0; i < h.nodeCount(); ++i) {
        const NodeId id{i};
        if (h.kind(id) != NodeKind::element || h.shape(id).exposed <= 0.0f) {
            continue;
        }
        EXPECT_FLOAT_EQ(h.light(id).radiosity.r, .3f);
        EXPECT_FLOAT_EQ(h.light(id).radiosity.g, .7f);
        EXPECT_FLOAT_EQ(h.light(id).radiosity.b, 1.1f);
        EXPECT_LT(h.light(id).range(), 1e-5f);
    }
}

// What all links deliver, each end once, in lm.
Vec3d deliveredPower(const Problem& problem) {
    const Hierarchy& h = problem.hierarchy;
    Vec3d sum(0.0);
    for (const hierarchy::Link& link : problem.links.links) {
        for (const bool toA : {true, false}) {
            const NodeId source = toA ? link.b : link.a;
            const base::Vec2 slope = (toA ? link.gradientB : link.gradientA).decode();
            const hierarchy::LocalFrame& frame = hierarchy::localFrame(h.shape(source).cornerCount);
            const hierarchy::Light& light = h.light(source);
            Rgb sent = light.radiosity;
            for (int c = 0; c < 3; ++c) {
                sent[c] += frame.product(slope, {light.slopeS[c], light.slopeT[c]});
            }
            sum += static_cast<double>(link.transfer()) * Vec3d(sent);
        }
    }
    return sum;
}

}  // namespace

TEST(PushPull, pullConservesPower) {
    expectPullConservesPower(*makeFurnace());
    expectPullConservesPower(*makeSphere(6));
}

TEST(PushPull, constantsAreKept) {
    expectConstantsAreKept(*makeFurnace());
    expectConstantsAreKept(*makeSphere(6));
}

// Check 10, true-area mode: leaves together have exactly their patches' area, at every level.
TEST(PushPull, areasOfTheSphereAddUp) {
    for (const unsigned level : {0u, 1u, 3u, 6u}) {
        const auto problem = makeSphere(level);
        const std::vector<NodeId> leaves = test::leavesOf(problem->hierarchy);
        EXPECT_EQ(leaves.size(), 8u << (2 * level));
        double area = 0.0;
        for (const NodeId id : leaves) {
            area += static_cast<double>(problem->hierarchy.shape(id).area);
        }
        EXPECT_NEAR(area / (4.0 * base::kPi * 1.5 * 1.5), 1.0, 1e-6) << level;
    }
}

// Links deliver at all levels; push moves that to the leaves and loses nothing, hidden parts included.
TEST(PushPull, pushConservesPower) {
    const auto problem = makeFurnace();
    light(*problem, randomColour);
    solve::Sweeper sweeper(*problem);
    sweeper.sweep();
    const Vec3d delivered = deliveredPower(*problem);
    sweeper.sweep();
    Vec3d arrived(0.0);
    for (const NodeId id : test::leavesOf(problem->hierarchy)) {
        arrived += static_cast<double>(problem->hierarchy.shape(id).exposedArea()) *
                   Vec3d(problem->hierarchy.light(id).irradiance);
    }
    expectEqual(arrived, delivered, 1e-5);
}

}  // namespace fluxwalk
