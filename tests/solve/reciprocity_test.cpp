#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/scene/builders.h"
#include "core/solve/audit.h"
#include "tests/support/solving.h"

// Reciprocity of the whole operator, links with push and pull: what leaf set 1 sends to 2 is what 2 sends to
// 1. And negative test n5: a coupling that is not the same both ways does not pass.

namespace fluxwalk {

namespace {

using base::NodeId;
using base::Vec3d;
using test::Problem;

std::unique_ptr<Problem> makeFurnace() {
    solve::Options options;
    options.minArea = .02;
    auto problem = test::makeProblem(scene::buildFurnace(.5f, false), options);
    test::refine(*problem, 1e-9);
    return problem;
}

float randomRadiosity(std::uint64_t seed, NodeId id) {
    return static_cast<float>(base::toUnit(base::combine(seed, base::index(id))));
}

using Operator = std::function<std::vector<double>(const std::function<float(NodeId)>&)>;

// |(u, K v) - (K u, v)| / (u, K v), areas as weights.
double reciprocityDefect(const Problem& problem, const Operator& transport) {
    const auto u = [](NodeId id) { return randomRadiosity(1, id); };
    const auto v = [](NodeId id) { return randomRadiosity(2, id); };
    const std::vector<double> ku = transport(u);
    const std::vector<double> kv = transport(v);
    double one = 0.0;
    double other = 0.0;
    for (const NodeId id : test::leavesOf(problem.hierarchy)) {
        const double area = static_cast<double>(problem.hierarchy.shape(id).exposedArea());
        one += area * static_cast<double>(u(id)) * kv[base::index(id)];
        other += area * static_cast<double>(v(id)) * ku[base::index(id)];
    }
    return std::abs(one - other) / one;
}

// Transport whose links give object 0, the floor, 5 % more than they take from it.
std::vector<double> transportLopsided(Problem& problem, const std::function<float(NodeId)>& radiosity) {
    std::vector<double> result = test::transport(problem, radiosity);
    std::vector<hierarchy::Link> kept = problem.links.links;
    for (hierarchy::Link& link : problem.links.links) {
        link.coupling *= 1.05f;
    }
    const std::vector<double> more = test::transport(problem, radiosity);
    problem.links.links = std::move(kept);
    for (const NodeId id : test::leavesOf(problem.hierarchy)) {
        if (problem.hierarchy.name(id).object == 0) {
            result[base::index(id)] = more[base::index(id)];
        }
    }
    return result;
}

// Solves B = E + rho K B on the leaves with any K and leaves the result in the hierarchy.
void solveWith(Problem& problem, const Operator& transport) {
    hierarchy::Hierarchy& h = problem.hierarchy;
    std::vector<double> irradiance(h.nodeCount(), 0.0);
    for (int sweep = 0; sweep < 40; ++sweep) {
        irradiance = transport([&](NodeId id) {
            const hierarchy::Light& light = h.light(id);
            return light.emission.g + light.reflectance.g * static_cast<float>(irradiance[base::index(id)]);
        });
    }
    for (const NodeId id : test::leavesOf(h)) {
        h.light(id).irradiance = base::Rgb(static_cast<float>(irradiance[base::index(id)]));
    }
}

}  // namespace

TEST(Reciprocity, holdsForTheWholeOperator) {
    const auto problem = makeFurnace();
    const Operator asSolved = [&](const auto& radiosity) { return test::transport(*problem, radiosity); };
    EXPECT_LT(reciprocityDefect(*problem, asSolved), 1e-6);
}

// Links of many levels: linear ends are projected on the way up and spread on the way down, which is adjoint
// in the means and nearly so in the slopes.
TEST(Reciprocity, holdsAcrossLevels) {
    const auto problem = test::makeProblem(scene::buildFurnace(.5f, false));
    test::refine(*problem, 1e-5);
    const Operator asSolved = [&](const auto& radiosity) { return test::transport(*problem, radiosity); };
    EXPECT_LT(reciprocityDefect(*problem, asSolved), 1e-4);
}

TEST(Reciprocity, lopsidedCouplingIsCaught) {
    const auto problem = makeFurnace();
    const Operator lopsided = [&](const auto& radiosity) { return transportLopsided(*problem, radiosity); };
    EXPECT_GT(reciprocityDefect(*problem, lopsided), 1e-4);
}

// The energy audit sees it too: the furnace would absorb more than it emits.
TEST(Reciprocity, auditCatchesLopsidedCoupling) {
    const auto problem = makeFurnace();
    solveWith(*problem, [&](const auto& radiosity) { return test::transport(*problem, radiosity); });
    const double right = solve::auditEnergy(*problem, 1000).relativeDefect();
    EXPECT_LT(right, .002);
    solveWith(*problem, [&](const auto& radiosity) { return transportLopsided(*problem, radiosity); });
    const double wrong = solve::auditEnergy(*problem, 1000).relativeDefect();
    EXPECT_GT(wrong, .005);
    EXPECT_GT(wrong, 5.0 * right);
}

}  // namespace fluxwalk
