#include <gtest/gtest.h>

#include "tests/support/curved_scenes.h"
#include "tests/support/solving.h"

// Checks 7 and 8 for every curved shape, rows not scaled: closed rooms with a solid of each kind, and hollow
// shapes seen from inside. As for planar elements (furnace_test.cpp), leaves are linked to each other
// directly.

namespace fluxwalk {

namespace {

using base::NodeId;
using test::Problem;

constexpr double kThreshold = 1e-9;  // lux; the irradiance is 2

class CurvedClosure : public testing::TestWithParam<test::CurvedScene> {};

std::string nameOf(const testing::TestParamInfo<test::CurvedScene>& given) {
    return given.param.name;
}

// Radiosity relative to 1 / (1 - rho), less 1.
test::Deviations solveFurnace(Problem& problem, float rho) {
    test::setReflectance(problem, rho);
    test::converge(problem, 1e-8);
    return test::deviations(problem, [&](NodeId id) {
        return static_cast<double>(problem.hierarchy.light(id).radiosity.g) *
                   (1.0 - static_cast<double>(rho)) -
               1.0;
    });
}

}  // namespace

TEST_P(CurvedClosure, rowsSumToOne) {
    scene::Scene scene = test::glowingScene(GetParam().name);
    GetParam().fill(scene);
    solve::Options options;
    options.minArea = GetParam().leafArea;
    const auto problem = test::makeProblem(std::move(scene), options);
    test::refine(*problem, kThreshold);
    const std::vector<double> sums = test::transportedRowSums(*problem);
    const test::Deviations rows =
        test::deviations(*problem, [&](NodeId id) { return sums[base::index(id)] - 1.0; });
    EXPECT_LE(std::abs(rows.mean), .001);
    EXPECT_LE(rows.meanSize, .001);
    EXPECT_LE(rows.percentile99, .01);
    EXPECT_LE(solveFurnace(*problem, .5f).largest, .01);
    EXPECT_LE(std::abs(solveFurnace(*problem, .9f).mean), .01);
}

INSTANTIATE_TEST_SUITE_P(Rooms, CurvedClosure, testing::ValuesIn(test::roomsWithSolids()), nameOf);
INSTANTIATE_TEST_SUITE_P(Hollows, CurvedClosure, testing::ValuesIn(test::hollows()), nameOf);

}  // namespace fluxwalk
