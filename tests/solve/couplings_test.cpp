#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/transport/coefficients.h"
#include "tests/analytic/closed_forms.h"
#include "tests/support/solving.h"

namespace fluxwalk {

namespace {

using test::makeProblem;
using test::Problem;

// Without reflection the receiver's mean irradiance is the form factor, as its links add up to it.
double transportedFactor(const scene::Scene& scene, double threshold, std::uint32_t receiver = 1) {
    const auto problem = makeProblem(scene);
    test::refine(*problem, threshold);
    test::converge(*problem);
    return test::meanIrradiance(*problem, receiver).x;
}

using PairName = std::tuple<std::uint32_t, surface::Path, std::uint32_t, surface::Path>;

// Couplings by the names of their ends, that of object 0 first.
std::map<PairName, std::pair<float, float>> namedCouplings(const Problem& problem) {
    std::map<PairName, std::pair<float, float>> named;
    for (const hierarchy::Link& link : problem.links.links) {
        hierarchy::ElementName a = problem.hierarchy.name(link.a);
        hierarchy::ElementName b = problem.hierarchy.name(link.b);
        if (a.object > b.object) {
            std::swap(a, b);
        }
        named[{a.object, a.path, b.object, b.path}] = {link.coupling, link.visibility()};
    }
    return named;
}

scene::Scene exchangeRoles(scene::Scene scene) {
    std::swap(scene.objects[0].material, scene.objects[1].material);
    return scene;
}

}  // namespace

// Check 4.
TEST(Couplings, parallelSquares) {
    EXPECT_NEAR(transportedFactor(scene::buildParallelSquares(1.0), 1e-6) / .199824896, 1.0, 1e-3);
}

TEST(Couplings, perpendicularSquares) {
    EXPECT_NEAR(transportedFactor(scene::buildWedge(90.0), 1e-6) / .200043776, 1.0, 1e-3);
}

TEST(Couplings, wedgeOfThirtyDegrees) {
    EXPECT_NEAR(transportedFactor(scene::buildWedge(30.0), 1e-6) / .619028323, 1.0, 1e-3);
}

TEST(Couplings, otherGapsAndAngles) {
    for (const double gap : {.5, 2.0, 10.0}) {
        const double exact = closed_forms::parallelRectangles(1, 1, gap);
        EXPECT_NEAR(transportedFactor(scene::buildParallelSquares(gap), 1e-6 * exact) / exact, 1.0, 1e-3)
            << gap;
    }
    // ALGORITHMS 3.2.
    for (const auto& [degrees, exact] : {std::pair{60.0, .370905321}, std::pair{120.0, .086615001}}) {
        EXPECT_NEAR(transportedFactor(scene::buildWedge(degrees), 1e-6) / exact, 1.0, 1e-3) << degrees;
    }
}

// The coupling of a pair is one number for both directions: whichever square emits, links between the same
// two elements carry the same bits.
TEST(Couplings, areReciprocalToTheBit) {
    // All links are between elements of 1/64 m2, whoever emits.
    solve::Options options;
    options.minArea = .02;
    for (const double degrees : {30.0, 90.0}) {
        const scene::Scene scene = scene::buildWedge(degrees);
        const auto there = makeProblem(scene, options);
        const auto back = makeProblem(exchangeRoles(scene), options);
        test::refine(*there, 0.0);
        test::refine(*back, 0.0);
        const auto one = namedCouplings(*there);
        EXPECT_EQ(one.size(), 64u * 64u);
        EXPECT_EQ(one, namedCouplings(*back));
        test::converge(*there);
        test::converge(*back);
        EXPECT_FLOAT_EQ(static_cast<float>(test::meanIrradiance(*there, 1).x),
                        static_cast<float>(test::meanIrradiance(*back, 0).x));
    }
}

// The answer to (a, b) is the answer to (b, a).
TEST(Couplings, doNotDependOnTheOrderOfTheQuery) {
    const auto problem = makeProblem(scene::buildFurnace(.5f, false));
    test::refine(*problem, 1e-3);
    const transport::CoefficientService service(problem->hierarchy, problem->rays);
    std::size_t mixed = 0;
    for (std::size_t i = 0; i < problem->links.links.size(); i += 7) {
        const hierarchy::Link& link = problem->links.links[i];
        const std::vector<transport::Query> queries{{link.a, link.b, false}, {link.b, link.a, false}};
        std::vector<transport::Coefficient> out(2);
        service.compute(queries, out);
        EXPECT_FLOAT_EQ(out[0].coupling, out[1].coupling);
        EXPECT_EQ(out[0].visibility, out[1].visibility);
        mixed += out[0].isMixed ? 1u : 0u;
    }
    EXPECT_GT(mixed, 10u);
}

// Check 5: near contact without an explosion of links.
TEST(Couplings, squaresThatNearlyTouch) {
    const auto problem = makeProblem(scene::buildParallelSquares(.01));
    test::refine(*problem, 1e-5);
    test::converge(*problem);
    EXPECT_NEAR(test::meanIrradiance(*problem, 1).x / .980416603, 1.0, .01);
    EXPECT_LT(problem->links.links.size(), 200'000u);
}

}  // namespace fluxwalk
