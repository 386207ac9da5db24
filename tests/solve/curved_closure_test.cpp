#include <chrono>
#include <iostream>

#include <gtest/gtest.h>

#include "tests/support/curved_scenes.h"
#include "tests/support/solving.h"

namespace fluxwalk {

namespace {

using test::Problem;

class CurvedClosure : public testing::TestWithParam<test::CurvedScene> {};

}  // namespace

TEST_P(CurvedClosure, rowsSumToOne) {
    scene::Scene scene = test::glowingScene(GetParam().name);
    GetParam().fill(scene);
    solve::Options options;
    const char* f = getenv("LEAF");
    options.minArea = GetParam().leafArea * (f ? atof(f) : 1.0);
    auto t0 = std::chrono::steady_clock::now();
    const auto problem = test::makeProblem(std::move(scene), options, 1);
    test::refine(*problem, 1e-9);
    auto t1 = std::chrono::steady_clock::now();
    const std::vector<double> sums = test::transportedRowSums(*problem);
    const auto rows =
        test::deviations(*problem, [&](base::NodeId id) { return sums[base::index(id)] - 1.0; });
    std::cout << GetParam().name << " leaves " << test::leavesOf(problem->hierarchy).size() << " links "
              << problem->links.links.size() << " rays " << problem->statistics.counters.rays << " t "
              << std::chrono::duration<double>(t1 - t0).count() << " mean " << rows.mean << " size "
              << rows.meanSize << " p99 " << rows.percentile99 << " max " << rows.largest << std::endl;
    for (std::uint32_t o = 0; o < problem->scene->objects.size(); ++o) {
        double m = 0, a = 0, s = 0;
        for (auto id : test::leavesOf(problem->hierarchy)) {
            if (problem->hierarchy.name(id).object != o)
                continue;
            double w = problem->hierarchy.shape(id).exposedArea();
            a += w;
            m += w * (sums[base::index(id)] - 1);
            s += w * std::abs(sums[base::index(id)] - 1);
        }
        std::cout << "   " << problem->scene->objects[o].name << " area " << a << " mean " << m / a
                  << " size " << s / a << std::endl;
    }
    EXPECT_LE(rows.meanSize, .001);
    EXPECT_LE(rows.percentile99, .01);
}

INSTANTIATE_TEST_SUITE_P(Rooms, CurvedClosure, testing::ValuesIn(test::roomsWithSolids()),
                         [](const auto& given) { return given.param.name; });
INSTANTIATE_TEST_SUITE_P(Hollows, CurvedClosure, testing::ValuesIn(test::hollows()),
                         [](const auto& given) { return given.param.name; });

}  // namespace fluxwalk
